/** Parts that `bundle.mjs` puts into the page. */
declare module '@wasm/*.mjs' {
  const make: import('./engine/binding').Make;
  export default make;
}
declare module '@wasm/*.wasm' {
  /** Base64 of the gzipped module. */
  const packed: string;
  export default packed;
}
declare module '@worker' {
  const code: string;
  export default code;
}
declare module '@cases/*' {
  const text: string;
  export default text;
}
declare module '@citation' {
  const text: string;
  export default text;
}
declare module '@licences' {
  const licences: { name: string; text: string }[];
  export default licences;
}
declare module '@events' {
  const events: { events: import('./model/events').PublishedEvent[] };
  export default events;
}
declare module '*/katex.min.css' {
  const style: string;
  export default style;
}
declare module '*.css' {}
