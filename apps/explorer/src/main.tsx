/** The page: its header, its routes, and the announcements for screen readers. */

import './style.css';
import { render, type ComponentType } from 'preact';
import { useEffect, useState } from 'preact/hooks';
import { signal } from '@preact/signals';
import { addressOf, entryOf, linkTo, route, setParams, unitParams } from './state/route';
import { refreshUnits, stated, wantsUnits } from './state/units';
import { said } from './ui/announce';
import { setTheme, theme } from './ui/colors';
import { Sources } from './ui/site';
import { UnitsForm } from './ui/units_form';
import { HomePanel } from './panels/home';
import { TourBar } from './panels/tour_bar';

/** A panel whose code runs when it is first shown, so that the first picture need not wait for it. */
function lazily(load: () => Promise<ComponentType>): ComponentType {
  let known: ComponentType | null = null;
  return () => {
    const [View, setView] = useState<ComponentType | null>(() => known);
    useEffect(() => {
      if (!known) load().then((view) => { known = view; setView(() => view); });
    }, []);
    return View ? <View /> : <p class="busy">Loading …</p>;
  };
}

interface Page {
  /** The name in the menu, if it is there. */
  name?: string;
  heading: string;
  about: string;
  view: ComponentType;
}
const pages: Record<string, Page> = {
  pulse: {
    name: 'Pulse', heading: 'A slip pulse', view: lazily(async () => (await import('./panels/pulse')).PulsePanel),
    about: 'Stress is stored on one side. A pulse of slip opens between two fronts: a fast one that runs into the stressed side, and a slow one ahead. Change the stress, change the friction, and press play.',
  },
  dislocations: {
    name: 'Dislocations', heading: 'Every dislocation', view: lazily(async () => (await import('./panels/dislocations')).DislocationsPanel),
    about: 'The same scenario without any average. Each bead is one dislocation: where it passes, the interface slips by one spacing of its asperities.',
  },
  loading: {
    name: 'Stick-slip', heading: 'Stick and slip', view: lazily(async () => (await import('./panels/loading')).LoadingPanel),
    about: 'A spring pulls a block over a table. Its friction falls with the velocity, and rises while it rests. So it sticks, and slips, and sticks again. Change the spring, and see where that ends.',
  },
  plane: {
    name: 'Fault plane', heading: 'A rupture on a fault plane', view: lazily(async () => (await import('./panels/plane')).PlanePanel),
    about: 'On a plane, dislocations are lines, and slip grows where they pass. Watch a rupture spread, by its averages or line by line. A bent line pulls back like a stretched string, and that can stop it.',
  },
  stress: {
    name: 'Stress and velocity', heading: 'Stress from observed velocities', view: lazily(async () => (await import('./panels/stress')).StressPanel),
    about: 'Without friction, the stress before a rupture fixes how fast it spreads and how fast it slips. Read backwards, observed velocities give the stress. Six decades of velocity are less than one decade of stress.',
  },
  riemann: {
    name: 'Riemann', heading: 'Two trains meet', view: lazily(async () => (await import('./panels/riemann')).RiemannPanel),
    about: 'Left and right of one point lie two uniform trains of dislocations. What happens next depends only on x/t: fans, where they spread, and two trains at one position, where dislocations overtake each other.',
  },
  paper: {
    name: 'The paper', heading: 'The figures of the paper, live', view: lazily(async () => (await import('./panels/paper')).PaperPanel),
    about: 'Gershenzon, Bambakidis & Skinner (Lubricants, 2015) drew these figures for a few numbers. Here each has sliders.',
  },
  licences: {
    heading: 'Licences and citation', view: lazily(async () => (await import('./panels/licences')).LicencesPanel),
    about: 'slipfront is free software. This page also contains free code and fonts of others.',
  },
};

const unitsOpen = signal(false);

function Top() {
  const here = route.value.panel;
  const dark = theme.value >= 0 && getComputedStyle(document.documentElement).colorScheme === 'dark';
  return (
    <header class="top">
      <a class="brand" href={addressOf({ panel: '', params: unitParams() })}>slipfront</a>
      <nav aria-label="Panels">
        {Object.entries(pages).filter(([, page]) => page.name).map(([key, page]) => (
          <a href={linkTo(key)} aria-current={key === here ? 'page' : undefined}>{page.name}</a>
        ))}
      </nav>
      <div class="tools">
        <button type="button" aria-expanded={unitsOpen.value} onClick={() => (unitsOpen.value = !unitsOpen.value)}>Units{wantsUnits.value ? ': SI' : ''}</button>
        <button type="button" onClick={() => setTheme(dark ? 'light' : 'dark')}>{dark ? 'Light' : 'Dark'}</button>
      </div>
    </header>
  );
}

function App() {
  const page = entryOf(pages, route.value.panel);
  useEffect(() => {
    if (wantsUnits.value) refreshUnits();
  }, [wantsUnits.value, stated.value.join()]);
  useEffect(() => {
    document.title = page ? `${page.heading} – slipfront explorer` : 'slipfront explorer';
    document.querySelector('main')?.focus({ preventScroll: true });
    scrollTo(0, 0);
  }, [page]);
  const unknown = !page && route.value.panel !== '';
  return (
    <>
      <a class="skip" href="#main" onClick={(e) => { e.preventDefault(); document.querySelector('main')?.focus(); }}>To the content</a>
      <Top />
      <main id="main" tabIndex={-1}>
        {unitsOpen.value && <UnitsForm onClose={() => (unitsOpen.value = false)} onToggle={(on) => setParams({ si: on ? '1' : null })} />}
        <TourBar />
        {page && <div class="intro"><h1>{page.heading}</h1>{!route.value.params.tour && <p>{page.about}</p>}</div>}
        {unknown && <p class="busy" role="status">There is no panel “{route.value.panel.slice(0, 60)}”. Allowed: {Object.keys(pages).join(', ')}.</p>}
        {page ? <page.view key={route.value.panel} /> : <HomePanel />}
      </main>
      <footer><Sources /></footer>
      <p class="said" role="status" aria-live="polite">{said.value}</p>
    </>
  );
}

render(<App />, document.getElementById('app')!.appendChild(document.createElement('div')));
document.querySelector('#app > p')?.remove();
