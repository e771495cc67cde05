declare module '@wasm/slipfront.mjs' {
  const make: (options: object) => Promise<any>;
  export default make;
}
declare module '@wasm/slipfront.wasm?url' {
  const address: string;
  export default address;
}
declare module '@events' {
  const events: { events: Record<string, any>[] };
  export default events;
}
