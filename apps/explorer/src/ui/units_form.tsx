/** SI units and the constants that they need. */

import { route, setParams } from '../state/route';
import { constants, stated, units, unitsProblem, wantsUnits } from '../state/units';
import { about, Check, sentence, TextField } from './fields';
import { inUnits } from './format';

export function UnitsForm({ onClose, onToggle }: { onClose: () => void; onToggle: (on: boolean) => void }) {
  const u = units.value;
  return (
    <section class="card units" aria-label="Units">
      <Check label="Show km/s, MPa and metres in place of the dimensionless units" checked={wantsUnits.value} onInput={onToggle} />
      <div class="row">
        {constants.map(({ key, label }, i) => (
          <TextField key={key} label={label} value={route.value.params[key] ?? stated.value[i]} error={sentence(about(unitsProblem.value, key))} onInput={(text) => setParams({ [key]: text, si: '1' })} />
        ))}
      </div>
      {unitsProblem.value && !unitsProblem.value.key && <p class="error" role="alert">{sentence(unitsProblem.value)}</p>}
      {u && wantsUnits.value && (
        <p class="hint">One unit of length is {inUnits('length', u.length)}, of time {inUnits('time', u.time)}, of stress {inUnits('stress', u.stress)}, of slip velocity {inUnits('velocity', u.slip_velocity)}; strain waves run at {inUnits('velocity', u.speed)}.</p>
      )}
      <button type="button" onClick={onClose}>Close</button>
    </section>
  );
}
