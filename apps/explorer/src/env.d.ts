declare module '@wasm/slipfront.mjs' {
  const make: (options: object) => Promise<import('./engine/binding').Module>;
  export default make;
}
declare module '@wasm/slipfront.wasm?url' {
  const address: string;
  export default address;
}
declare module '@events' {
  const events: { events: import('./model/events').PublishedEvent[] };
  export default events;
}
