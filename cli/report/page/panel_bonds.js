// Breaking bonds: energies, cracks and fragments over time, and the fragment sizes in the current frame.
'use strict';

const hasBondSeries = run => run.has('bonds/crack_length') && run.times.length > 1;

addFigures(run => {
  const {bonds} = run.summary;
  if (!bonds) return [];
  return [
    [
      'fragments', countOf(bonds.fragments),
      bonds.broken ? `${countOf(bonds.broken)} of ${countOf(bonds.made)} bonded points broken` :
                     'no bond broken'
    ],
    bonds.crack_length > 0 &&
        [
          'crack length', withUnit(bonds.crack_length, 'm', 3),
          `${percent(bonds.mode_2_share)} of its energy in mode II`
        ]
  ];
});

addCurves(run => !hasBondSeries(run) ? [] : [
  {
    title: 'Crack length',
    xs: [timeAxis(run)],
    y: 'crack length',
    lines: [run.series('bonds/crack_length', 'crack length')]
  },
  {
    title: 'Fragments',
    xs: [timeAxis(run)],
    y: 'fragments',
    lines: [run.series('bonds/fragments', 'fragments')]
  }
]);

function bondPanel(title, order, y, names) {
  addPanel({
    title,
    order,
    when: run =>
        hasBondSeries(run) && Object.keys(names).some(name => largest(run.values(name)) > 0),
    draw(report, host) {
      const lines = Object.entries(names).map(([name, label]) => report.run.series(name, label));
      report.chart(host, {x: timeAxis(report.run), y, lines});
    },
  });
}
bondPanel('Bonds: crack length', 20, 'crack length', {'bonds/crack_length': 'broken so far'});
bondPanel(
    'Bonds: energy', 21, 'energy',
    {'energy/fracture': 'dissipated in breaking', 'energy/bonds': 'stored in bonds'});
bondPanel('Bonds: fragments', 22, 'fragments', {'bonds/fragments': 'fragments'});
bondPanel('Bonds: damage and largest fragment', 23, 'share', {
  'bonds/damage': 'broken share of the bonds',
  'bonds/largest_fragment': 'area of the largest fragment'
});

// Cumulative fractions up to a diameter, as steps; by number and by area.
function drawSizes(ctx, width, height, {diameter, number, area}, most) {
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
  [['of the area', area], ['of the number', number]].forEach(([label, shares], i) => {
    ctx.strokeStyle = ctx.fillStyle = theme().lines[i];
    ctx.fillText(label, left + 110 * i, 12);
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
    report.figure(host, {
      title: 'Sizes of the fragments',
      shape: 0.75,
      draw: (ctx, width, height, {fragments}) =>
          drawSizes(ctx, width, height, fragments, most(report.beside.flatMap(run => run.frames))),
      note: frame => `Share of the fragments up to a given diameter (of the circle of equal area): ` +
          `${
                         frame.fragments.count === 1 ?
                             'one fragment' :
                             `${countOf(frame.fragments.count)} fragments`} ${atTime(frame)}.`,
      columns: ({fragments: {diameter, number, area}}) =>
          [{label: 'equivalent diameter', unit: 'm', values: diameter},
           {label: 'share of the number', unit: '-', values: number},
           {label: 'share of the area', unit: '-', values: area}]
    });
  },
});
