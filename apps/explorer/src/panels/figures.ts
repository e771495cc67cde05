/** The figures of the paper: what each shows, which sliders it has, and how it starts. */

export interface Slider {
  key: string;
  label: string;
  value: string;
  least: number;
  most: number;
  log?: boolean;
}
export interface Figure {
  title: string;
  text: string;
  sliders: Slider[];
  closure?: boolean;
  logarithmic?: boolean;
}

const left = (value = '0.855'): Slider => ({ key: 'left', label: 'Stress Σ−', value, least: 0.15, most: 1.5 });
const right = (value = '0.179'): Slider => ({ key: 'right', label: 'Stress Σ+', value, least: 0, most: 1.2 });
const width = (value = '1'): Slider => ({ key: 'width', label: 'Width of the profile', value, least: 0.05, most: 4, log: true });
const friction = (key: string, value: string): Slider => ({ key, label: 'Friction C', value, least: 0.01, most: 10, log: true });

export const figures: Record<string, Figure> = {
  2: {
    title: 'Fig. 2: a train of dislocations', text: 'The average is smooth; at the scale of a dislocation slip comes in peaks. The average of the peaks is the line.',
    sliders: [{ key: 'stress', label: 'Stress at rest', value: '0.4', least: 0.05, most: 2 }, { key: 'velocity', label: 'Velocity U, in c', value: '0.3', least: 0, most: 0.95 }],
  },
  3: { title: 'Fig. 3: the stress before', text: 'A step, and a smooth profile. The paper does not state the width of its smooth one; here it is a slider.', sliders: [left(), right(), width()] },
  4: { title: 'Fig. 4: the ratio of the two fronts', text: 'In a slow event the fast front outruns the slow one the more, the slower both are.', sliders: [{ key: 'least', label: 'Slowest |V−|, in c', value: '1e-8', least: 1e-300, most: 0.01, log: true }] },
  5: { title: 'Fig. 5: rupture velocity against stress', text: 'A decade of stress is more than six decades of rupture velocity. Dots: Parkfield and a slow slip event.', sliders: [{ key: 'least', label: 'Slowest |V−|, in c', value: '1e-8', least: 1e-300, most: 0.01, log: true }] },
  6: { title: 'Fig. 6: slip velocity against stress', text: 'Without friction, a decade of stress is more than seven decades of slip velocity.', sliders: [{ key: 'least', label: 'Slowest |V−|, in c', value: '1e-8', least: 1e-300, most: 0.01, log: true }] },
  7: { title: 'Fig. 7: slip velocity over x and t', text: 'More friction lowers the pulse, but hardly changes how far it has run.', sliders: [friction('C', '0.1'), left(), right(), width()], closure: true },
  8: {
    title: 'Fig. 8: slip velocity for three frictions', text: 'Each curve is scaled to the peak of the first, as in the paper, where the factors are 1.8 and 5.2.',
    sliders: [friction('C1', '0.1'), friction('C2', '0.5'), friction('C3', '2'), left(), right(), width('1.6')], closure: true, logarithmic: true,
  },
  9: { title: 'Fig. 9: stress for three frictions', text: 'The larger the friction, the smoother the transition.', sliders: [friction('C1', '0.1'), friction('C2', '0.5'), friction('C3', '2'), left(), right(), width()], closure: true },
  10: {
    title: 'Fig. 10: reduction of slip velocity by friction', text: 'Slip velocity at x = 0 over that without friction. The paper reads 0.83, 0.5 and 0.2 off it for Parkfield.',
    sliders: [left(), { ...left('0.606'), key: 'left2', label: 'Stress Σ−, second' }, { ...left('0.419'), key: 'left3', label: 'Stress Σ−, third' }, right(), width('0.1')], closure: true,
  },
  11: { title: 'Fig. 11: a stressed right side', text: 'The pulse hardly changes until the stress on the right comes near that on the left; then it is nearly symmetric.', sliders: [right('0.8'), left(), friction('C', '0.1'), width()], closure: true },
  12: {
    title: 'Fig. 12: slip velocity against the drop of stress', text: 'The paper finds it flat from 35 to 100 %. With the exact jump conditions it falls by a quarter at 42 %.',
    sliders: [left(), { ...left('0.606'), key: 'left2', label: 'Stress Σ−, second' }, friction('C', '0.1')], closure: true,
  },
};
