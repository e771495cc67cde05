/** The parts that all SVG pictures have: a sheet with the title and the link to the scenario, and axes. */

export type Color = (name: string) => string;

export interface Box {
  left: number;
  right: number;
  top: number;
  bottom: number;
}
export interface Axis {
  label: string;
  /** Positions of the ticks in pixels, and their texts. */
  ticks: { at: number; text: string }[];
}

export const escape = (text: string) => text.replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/>/g, '&gt;');

/** The ticks and the labels of both axes. */
export function axes(box: Box, color: Color, x: Axis, y: Axis): string {
  const ink = color('ink');
  const below = x.ticks.map(({ at, text }) => `<path d="M${at} ${box.bottom}v5" stroke="${ink}"/><text x="${at}" y="${box.bottom + 20}" text-anchor="middle">${text}</text>`);
  const beside = y.ticks.map(({ at, text }) => `<path d="M${box.left} ${at}h-5" stroke="${ink}"/><text x="${box.left - 9}" y="${at + 4}" text-anchor="end">${text}</text>`);
  return `<path d="M${box.left} ${box.top}V${box.bottom}H${box.right}" fill="none" stroke="${ink}"/>
${[...below, ...beside].join('\n')}
<text x="${(box.left + box.right) / 2}" y="${box.bottom + 42}" text-anchor="middle">${escape(x.label)}</text>
${sideways(18, (box.top + box.bottom) / 2, y.label)}`;
}

/** A text that is read from below, centred on a point. */
export const sideways = (x: number, y: number, text: string) => `<text transform="translate(${x} ${y}) rotate(-90)" text-anchor="middle">${escape(text)}</text>`;

/** Entries of a legend, from `left` on. */
export function legend(left: number, color: Color, entries: { label?: string; color: string; dash?: number[] }[]): string {
  let at = left;
  return entries.flatMap(({ label, color: name, dash }) => {
    if (!label) return [];
    const entry = `<path d="M${at} 46h18" stroke="${color(name)}" stroke-width="2"${dash ? ` stroke-dasharray="${dash.join(' ')}"` : ''}/><text x="${at + 23}" y="50">${escape(label)}</text>`;
    at += 40 + 6.4 * label.length;
    return [entry];
  }).join('\n');
}

const linkLine = 118; // letters

/** A whole SVG picture. The link is below it, on as many lines as it needs. */
export function sheet(title: string, link: string, width: number, height: number, color: Color, body: string): string {
  const links = link.match(new RegExp(`.{1,${linkLine}}`, 'g')) ?? [];
  const whole = height + 13 * links.length + (links.length && 4);
  const fitted = (part: string) => (part.length < linkLine ? '' : ` textLength="${width - 28}" lengthAdjust="spacingAndGlyphs"`);
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${whole}" width="${width}" height="${whole}" font-family="Helvetica, Arial, sans-serif" font-size="12" fill="${color('ink')}">
<title>${escape(title)}</title>${link && `<desc>${escape(link)}</desc>`}<rect width="100%" height="100%" fill="${color('paper')}"/>
${body}
<text x="14" y="26" font-size="16" font-weight="bold">${escape(title)}</text>
${links.map((part, i) => `<text x="14" y="${height + 13 * i + 6}" font-size="10"${fitted(part)}>${escape(part)}</text>`).join('\n')}</svg>
`;
}
