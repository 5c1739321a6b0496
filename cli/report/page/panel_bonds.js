// Breaking bonds: energies, cracks and fragments over time, and the fragment sizes in the current frame.
'use strict';

// Cracks have a length in two dimensions and an area in three; fragments an area, or a volume.
const crackKind = run => run.has('bonds/crack_area') ? 'area' : 'length';
const fragmentKind = run => crackKind(run) === 'area' ? 'volume' : 'area';
const hasBondSeries = run => run.has(`bonds/crack_${crackKind(run)}`) && run.times.length > 1;

addFigures(run => {
  const {bonds} = run.summary;
  if (!bonds) return [];
  const kind = 'crack_area' in bonds ? 'area' : 'length', cracks = bonds[`crack_${kind}`];
  return [
    [
      'fragments', countOf(bonds.fragments),
      bonds.broken ? `${countOf(bonds.broken)} of ${countOf(bonds.made)} bonded points broken` :
                     'no bond broken'
    ],
    cracks > 0 &&
        [
          `crack ${kind}`, withUnit(cracks, kind === 'area' ? 'm^2' : 'm', 3),
          `${bonds.mode_2_share < 1e-3 ? 'less than 0.1 %' : percent(bonds.mode_2_share)} of its energy in mode II`
        ]
  ];
});

addCurves(run => {
  if (!hasBondSeries(run)) return [];
  const kind = crackKind(run);
  return [
    {
      title: `Crack ${kind}`,
      xs: [timeAxis(run)],
      y: `crack ${kind}`,
      lines: [run.series(`bonds/crack_${kind}`, `crack ${kind}`)]
    },
    {
      title: 'Fragments',
      xs: [timeAxis(run)],
      y: 'fragments',
      lines: [run.series('bonds/fragments', 'fragments')]
    }
  ];
});

// names(run): the label of each series.
function bondPanel(title, order, y, names, when = () => true) {
  addPanel({
    title,
    order,
    when: run => hasBondSeries(run) && when(run) &&
        Object.keys(names(run)).some(name => largest(run.values(name)) > 0),
    draw(report, host) {
      const lines =
          Object.entries(names(report.run)).map(([name, label]) => report.run.series(name, label));
      report.chart(host, {x: timeAxis(report.run), y, lines});
    },
  });
}
for (const kind of ['length', 'area'])
  bondPanel(
      `Bonds: crack ${kind}`, 20, `crack ${kind}`,
      () => ({[`bonds/crack_${kind}`]: 'broken so far'}), run => crackKind(run) === kind);
bondPanel(
    'Bonds: energy', 21, 'energy',
    () => ({'energy/fracture': 'dissipated in breaking', 'energy/bonds': 'stored in bonds'}));
bondPanel('Bonds: fragments', 22, 'fragments', () => ({'bonds/fragments': 'fragments'}));
bondPanel('Bonds: damage and largest fragment', 23, 'share', run => ({
  'bonds/damage': 'broken share of the bonds',
  'bonds/largest_fragment': `${fragmentKind(run)} of the largest fragment`
}));

// Cumulative fractions up to a diameter, as steps; by number and by area or volume (`kind`).
function drawSizes(ctx, width, height, kind, {diameter, number, [kind]: size}, most) {
  const unit = unitFor('m', most), left = 52, base = height - 40, top = 22, right = width - 14;
  const px = value => left + value / most * (right - left),
        py = share => base - share * (base - top);
  ctx.strokeStyle = theme().grid;
  ctx.fillStyle = theme().soft;
  const grid = (x0, y0, x1, y1) => {
    ctx.beginPath();
    ctx.moveTo(x0, y0);
    ctx.lineTo(x1, y1);
    ctx.stroke();
  };
  ctx.textAlign = 'center';
  for (const tick of niceTicks(0, most * unit.factor, 5)) {
    grid(px(tick / unit.factor), top, px(tick / unit.factor), base);
    ctx.fillText(digits(tick), px(tick / unit.factor), base + 16);
  }
  ctx.fillText(labelled('equivalent diameter', unit.label), (left + right) / 2, base + 34);
  ctx.textAlign = 'right';
  for (const share of [0, 0.25, 0.5, 0.75, 1]) {
    grid(left, py(share), right, py(share));
    ctx.fillText(percent(share), left - 6, py(share) + 4);
  }
  ctx.textAlign = 'left';
  ctx.lineWidth = 2;
  [[`of the ${kind}`, size], ['of the number', number]].forEach(([label, shares], i) => {
    ctx.strokeStyle = ctx.fillStyle = theme().lines[i];
    ctx.fillText(label, left + 120 * i, 12);
    ctx.beginPath();
    ctx.moveTo(px(0), py(0));
    diameter.forEach((value, k) => {
      ctx.lineTo(px(value), py(k ? shares[k - 1] : 0));
      ctx.lineTo(px(value), py(shares[k]));
    });
    ctx.stroke();
  });
  return `${most}`;
}

addPanel({
  title: 'Sizes of the fragments',
  order: 24,
  when: run => run.frames.some(frame => frame.fragments && frame.fragments.count > 1),
  draw(report, host) {
    // A common axis over all frames and over the runs shown side by side.
    const most = frames =>
        1.02 *
        largest(
            frames.filter(frame => frame.fragments).map(frame => frame.fragments.diameter.at(-1)));
    const kind = fragmentKind(report.run), body = kind === 'volume' ? 'sphere' : 'circle';
    report.figure(host, {
      title: 'Sizes of the fragments',
      shape: 0.75,
      draw: (ctx, width, height, {fragments}) => drawSizes(
          ctx, width, height, kind, fragments, most(report.beside.flatMap(run => run.frames))),
      note: frame => `Share of the fragments up to a given diameter (of the ${body} of equal ${
          kind}): ${
          frame.fragments.count === 1 ? 'one fragment' :
                                        `${countOf(frame.fragments.count)} fragments`} ${
          atTime(frame)}.`,
      columns: ({fragments: {diameter, number, [kind]: size}}) =>
          [{label: 'equivalent diameter', unit: 'm', values: diameter},
           {label: 'share of the number', unit: '-', values: number},
           {label: `share of the ${kind}`, unit: '-', values: size}]
    });
  },
});
