// The density along z in 3D, for the current frame.
"use strict";

const PROFILE_ROOMS = {die: "inside the die", "die with a mouth": "inside the die, below its mouth", walls: "inside the walls", powder: "bounded by the powder"};

function profileNote({profile: {profile, bound}, time}) {
  if (bound === "die across z") return "The die does not stand along z.";
  const at = `at ${withUnit(time, "s")}.`;
  if (!profile.length) return `Nothing is ${PROFILE_ROOMS[bound]}, ${at}`;
  return `Solid volume in ${profile.length} slices of equal thickness over the volume of the slice (${PROFILE_ROOMS[bound]}), ${at}`;
}

addPanel({
  title: "Relative density along z", order: 11, when: run => run.inSpace && run.frames.some(frame => frame.profile),
  draw(report, host) {
    const ends = frames => bounds(frames.filter(frame => frame.profile).map(({profile}) => profile.profile));
    report.figure(host, {
      title: "Relative density along z", shape: 0.75,
      draw: (ctx, width, height, {profile}, frames) => drawProfile(ctx, width, height, profile, ends(frames)),
      note: profileNote,
      columns: ({profile: {profile, y}}) => [
        {label: "z", unit: "m", values: profile.map((_, j) => (y[j] + y[j + 1]) / 2)},
        {label: "relative density", unit: "-", values: profile}]});
  },
});
