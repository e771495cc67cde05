/** The guided tour: states of the panels, with two sentences each. */

import type { Params } from '../state/route';

export interface Stop {
  panel: string;
  params: Params;
  title: string;
  text: string;
}

const step: Params = { 'initial.profile': 'step', 'initial.stress_left': '0.855', 'initial.stress_right': '0' };

export const stops: Stop[] = [
  {
    panel: 'dislocations', params: { ...step, 'friction.law': 'none', beads: '12' }, title: 'A dislocation',
    text: 'Two rough surfaces touch at their asperities, which rest in each other’s wells. A dislocation is the point where one row has just jumped ahead: where it passes, the interface has slipped by one spacing.',
  },
  {
    panel: 'paper', params: { fig: '2', stress: '0.4', velocity: '0.3' }, title: 'A train of dislocations',
    text: 'Stress packs dislocations into a train: the higher the stress, the closer they lie. If the train moves, the interface slips in peaks, and their average is the slip velocity that one can see.',
  },
  {
    panel: 'dislocations', params: { ...step, 'friction.law': 'none', beads: '200' }, title: 'A pulse is a gas of dislocations',
    text: 'On the left the train is packed, on the right there is nothing. The dislocations spread to the right one after the other, and a pulse of slip opens between those that have started and the first of all.',
  },
  {
    panel: 'pulse', params: { ...step, 'friction.law': 'none', play: '1' }, title: 'Two fronts',
    text: 'The news that the way is free runs back into the train: that is the fast front, V−, the rupture velocity one observes. The first dislocation runs ahead: that is the slow front, V+.',
  },
  {
    panel: 'pulse', params: { ...step, 'friction.law': 'viscous', 'friction.coefficient': '0.5', play: '1' }, title: 'What friction changes, and what not',
    text: 'Friction lowers the slip velocity and holds the slow front back. The fast front keeps its speed: it runs into an interface at rest, where friction has nothing to act on.',
  },
  {
    panel: 'pulse', params: { ...step, 'friction.law': 'viscous', 'friction.coefficient': '0.5', compare: '1' }, title: 'A mistake in the average',
    text: 'The paper averages friction over x, but dislocations feel the friction at their own positions, which is larger. The dashed curve is the paper’s: its slip is up to 37 % above what a chain of single dislocations does.',
  },
  {
    panel: 'riemann', params: { left_stress: '0.855', right_stress: '0.179', left_velocity: '0', right_velocity: '0' }, title: 'When the other side is stressed too',
    text: 'Then the dislocations overtake those ahead of them. At x = 0 two trains lie at one position: the picture of rapidities folds.',
  },
  {
    panel: 'stress', params: { range: 'fast', 'my.rupture_velocity': '3.0 +- 0.2 km/s', 'my.slip_velocity': '0.5 m/s' }, title: 'Parkfield, 2004',
    text: 'It spread at 3 km/s and slipped at about half a metre a second. The rupture velocity determines the stress over the contact ratio. The slip velocity gives the contact ratio if friction took nothing, and so a lower bound of about 28 MPa for the stress. Friction is not known: with 90 % probability, the stress lies between about 30 and 230 MPa.',
  },
  {
    panel: 'stress', params: { range: 'observed', 'my.rupture_velocity': '10 km/day', 'my.slip_velocity': '2 mm/week' }, title: 'Slow slip',
    text: 'A slow slip event spreads 26 000 times more slowly. It needs only five times less stress, because velocity falls so steeply with stress: one theory covers both.',
  },
  {
    panel: 'pulse', params: { 'initial.profile': 'table', drawn: '-6:0.9,-4.5:0.9,-3.5:0.55,-2.5:0.9,-1:0.75,0:0.35,1:0.1,2:0,4:0', 'friction.law': 'viscous', 'friction.coefficient': '0.2', 'time.end': '9', play: '1' }, title: 'Your turn',
    text: 'Draw your own stress in the plot below, choose a friction, and press play. The address of the page contains all settings, so a link shows the same picture to anyone.',
  },
];
