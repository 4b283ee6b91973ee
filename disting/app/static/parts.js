// Parts of a machine, as `disting/app/parts.py` describes them. Every function returns new parts.
export const GROUND = 0;
export const EMPTY = { masses: [], joints: [], forces: [], sensors: [], quantity: "acceleration" };

const isBetween = (joint, a, b) => (joint.from === a && joint.to === b) || (joint.from === b && joint.to === a);
const isAt = (node) => (ends) => ends.includes(node);

export const addMass = (parts) => {
  let node = 1;
  while (parts.masses.includes(node)) node += 1;
  return [{ ...parts, masses: [...parts.masses, node].sort((a, b) => a - b) }, node];
};

// What is at a mass goes with it.
export const removeMass = (parts, node) => ({
  ...parts,
  masses: parts.masses.filter((other) => other !== node),
  joints: parts.joints.filter(({ from, to }) => from !== node && to !== node),
  forces: parts.forces.filter((ends) => !isAt(node)(ends)),
  sensors: parts.sensors.filter((ends) => !isAt(node)(ends)),
});

// A joint of this kind in place of another one between the same two nodes.
export const join = (parts, a, b, kind, ratio = "") => {
  if (a === b) return parts;
  const [from, to] = a === GROUND ? [b, a] : b === GROUND || ratio || a < b ? [a, b] : [b, a];
  return { ...parts, joints: [...removeJoint(parts, a, b).joints, { from, to, kind, ratio }] };
};

export const removeJoint = (parts, a, b) => ({ ...parts, joints: parts.joints.filter((joint) => !isBetween(joint, a, b)) });

export const changeJoint = (parts, at, change) => ({ ...parts, joints: parts.joints.map((joint, i) => (i === at ? { ...joint, ...change } : joint)) });

// A name that no gear of the machine has.
const freeRatio = ({ joints }) => {
  for (let i = 1; ; i += 1) {
    const name = i > 1 ? `i${i}` : "i";
    if (!joints.some(({ ratio }) => ratio === name)) return name;
  }
};

// A gear at the end b of the joint of two masses, which gets one if there is none; a gear that is there goes.
export const toggleGear = (parts, a, b) => {
  if (a === GROUND || b === GROUND || a === b) return parts;
  const isOne = (joint) => isBetween(joint, a, b), old = parts.joints.find(isOne);
  if (!old) return join(parts, a, b, "both", freeRatio(parts));
  const ratio = old.ratio ? "" : freeRatio(parts), [from, to] = ratio || a < b ? [a, b] : [b, a];
  return { ...parts, joints: parts.joints.map((joint) => (joint === old ? { ...joint, from, to, ratio } : joint)) };
};

// A force or sensor ("forces", "sensors") between two nodes; where it is already it goes.
export const togglePort = (parts, side, plus, minus = GROUND) => {
  const isSame = (ends) => ends[0] === plus && ends[1] === minus;
  const ports = parts[side].some(isSame) ? parts[side].filter((ends) => !isSame(ends)) : [...parts[side], [plus, minus]];
  return plus === minus ? parts : { ...parts, [side]: ports };
};
