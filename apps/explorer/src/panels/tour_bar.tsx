/** The tour, above the panel that it is about. */

import { addressOf, go, route, unitParams } from '../state/route';
import { stops } from './tour';

export const addressOfStop = (index: number) => addressOf({ panel: stops[index].panel, params: { tour: String(index + 1), ...stops[index].params, ...unitParams() } });
const goToStop = (index: number) => { location.hash = addressOfStop(index); };

export function TourBar() {
  const number = Number(route.value.params.tour);
  if (!Number.isInteger(number) || number < 1 || number > stops.length) return null;
  const { title, text } = stops[number - 1];
  return (
    <section class="card tour" aria-label="Tour" aria-live="polite">
      <h2>{number}. {title}</h2>
      <p>{text}</p>
      <nav aria-label="Steps of the tour">
        <button type="button" disabled={number === 1} onClick={() => goToStop(number - 2)}>Back</button>
        {number < stops.length ? <button type="button" class="primary" onClick={() => goToStop(number)}>Next</button> : <button type="button" class="primary" onClick={() => go('', unitParams())}>Done</button>}
        <button type="button" onClick={() => go(route.value.panel, Object.fromEntries(Object.entries(route.value.params).filter(([key]) => key !== 'tour')))}>Leave the tour</button>
        <span class="count">step {number} of {stops.length}</span>
      </nav>
    </section>
  );
}
