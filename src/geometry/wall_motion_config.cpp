#include <fmt/format.h>

#include "geometry/wall_motion.h"

namespace sluice {

namespace {
constexpr double same_place = 1e-9;  // [m], and of turns [rad]
}

void WallKeyframe::keys(Schema& s) {
  s.number("time", time, {.unit = "s", .required = true, .at_least = 0, .doc = "when it is there"});
  s.vector("shift", shift, {.unit = "m", .doc = "of the centre, from its place in the CAD"});
  s.vector("turn", turn,
           {.unit = "rad",
            .doc = "about 'centre': axis times angle; about one axis it may be more than a full turn",
            .example = "[0 deg, 90 deg, 0 deg]"});
}

void WallMotion::keys(Schema& s) {
  s.choice("kind", kind,
           {{"vibration", MotionKind::vibration},
            {"rotation", MotionKind::rotation},
            {"keyframes", MotionKind::keyframes}},
           {.required = true,
            .doc = "vibration: along a line, an ellipse or a circle, as a screen box; rotation: a drum or a "
                   "paddle; keyframes: places and turns at given times"});
  const bool vibrates = kind == MotionKind::vibration, rotates = kind == MotionKind::rotation;
  const bool has_frames = kind == MotionKind::keyframes;
  const char* of_vibration = "kind: vibration";
  const char* of_both = "kind: vibration or rotation";
  const char* of_turns = "kind: rotation or keyframes";
  s.vector("direction", direction,
           {.required = vibrates,
            .doc = "of the stroke",
            .applies = vibrates,
            .applies_to = of_vibration,
            .example = "[1, 0, 1]"});
  s.number("stroke", stroke,
           {.unit = "m",
            .required = vibrates,
            .above = 0,
            .doc = "from end to end, twice the amplitude",
            .applies = vibrates,
            .applies_to = of_vibration,
            .example = "8 mm"});
  s.vector("cross_direction", cross_direction,
           {.doc = "of the second stroke: the orbit runs from here towards 'direction'",
            .applies = vibrates,
            .applies_to = of_vibration});
  s.number("cross_stroke", cross_stroke,
           {.unit = "m",
            .at_least = 0,
            .doc = "second stroke, a quarter of a period ahead: an ellipse, or a circle if both are alike "
                   "and square to each other",
            .applies = vibrates,
            .applies_to = of_vibration});
  s.number("frequency", frequency,
           {.unit = "Hz",
            .required = vibrates,
            .above = 0,
            .doc = "strokes to and fro in a time",
            .applies = vibrates,
            .applies_to = of_vibration,
            .example = "900 rpm"});
  s.number("phase", phase,
           {.unit = "rad",
            .doc = "at the start; at 0 deg the wall is in the middle of the first stroke",
            .applies = vibrates,
            .applies_to = of_vibration});
  s.vector(
      "axis", axis,
      {.required = rotates, .doc = "of the rotation", .applies = rotates, .applies_to = "kind: rotation"});
  s.number("speed", speed,
           {.unit = "rad/s",
            .required = rotates,
            .doc = "right-handed about the axis",
            .applies = rotates,
            .applies_to = "kind: rotation",
            .example = "10 rpm"});
  s.vector("centre", centre,
           {.unit = "m",
            .required = rotates,
            .doc = "a point of the axis; of keyframes, the point about which they turn",
            .applies = !vibrates,
            .applies_to = of_turns});
  s.number("start", start,
           {.unit = "s",
            .at_least = 0,
            .doc = "the wall stands until then, where the motion begins",
            .applies = !has_frames,
            .applies_to = of_both});
  s.number("ramp", ramp,
           {.unit = "s",
            .at_least = 0,
            .doc = "time in which stroke or speed grow smoothly from nothing",
            .applies = !has_frames,
            .applies_to = of_both});
  s.list("keyframes", keyframes,
         {.required = has_frames,
          .doc = "where the wall is when; in between it moves smoothly",
          .applies = has_frames,
          .applies_to = "kind: keyframes"});
  s.choice("after_last", after_last, {{"hold", AfterLast::hold}, {"repeat", AfterLast::repeat}},
           {.doc = "hold: the wall stands before the first keyframe and after the last; repeat: it goes on "
                   "from the first",
            .applies = has_frames,
            .applies_to = "kind: keyframes"});

  const auto need_length = [&](const char* key, const Vec3& v) {
    if (s.given(key) && v.norm() == 0)
      s.problem(key, "is [0, 0, 0]", "it has no direction", "give one component that is not zero");
  };
  if (vibrates) {
    need_length("direction", direction);
    need_length("cross_direction", cross_direction);
    if (s.given("cross_direction") && !s.given("cross_stroke"))
      s.problem("cross_direction", "is given without 'cross_stroke'", "a second stroke has a length",
                "add 'cross_stroke'");
    if (s.given("cross_stroke") && !s.given("cross_direction"))
      s.problem("cross_stroke", "is given without 'cross_direction'", "a second stroke has a direction",
                "add 'cross_direction'");
  }
  if (rotates) {
    need_length("axis", axis);
    if (s.given("speed") && speed == 0)
      s.problem("speed", "is zero", "the wall would stand", "leave 'motion' out");
  }
  if (!has_frames || !s.given("keyframes")) return;
  if (keyframes.size() < 2) {
    s.problem("keyframes",
              fmt::format("has {} entr{}", keyframes.size(), keyframes.size() == 1 ? "y" : "ies"),
              "a motion has a beginning and an end", "give two or more");
    return;
  }
  for (std::size_t k = 1; k < keyframes.size(); ++k)
    if (!(keyframes[k].time > keyframes[k - 1].time)) {
      s.problem("keyframes",
                fmt::format("has {:.6g} s after {:.6g} s", keyframes[k].time, keyframes[k - 1].time),
                "times ascend", "put them in order");
      return;
    }
  if (after_last != AfterLast::repeat) return;
  const WallKeyframe &first = keyframes.front(), &last = keyframes.back();
  if ((first.shift - last.shift).norm() > same_place || (first.turn - last.turn).norm() > same_place)
    s.problem("keyframes", "does not end where it begins", "a motion that repeats would jump",
              "end with the first keyframe's shift and turn, or use 'after_last: hold'");
}

}  // namespace sluice
