/** Panel "Licences": the licence of slipfront, how to cite it, and the licences of all code and fonts of others in this page. */

import citation from '@citation';
import licences from '@licences';

const Text = ({ name, text }: { name: string; text: string }) => <details class="licence"><summary>{name}</summary><pre>{text}</pre></details>;

export function LicencesPanel() {
  const [own, ...others] = licences;
  return (
    <>
      <Text {...own} />
      <Text name="Citation" text={citation} />
      <h2>Code and fonts of others in this page</h2>
      {others.map((one) => <Text {...one} />)}
    </>
  );
}
