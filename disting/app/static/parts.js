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

// A force or sensor ("forces", "sensors") between two nodes; where it is already it goes.
export const togglePort = (parts, side, plus, minus = GROUND) => {
  const isSame = (ends) => ends[0] === plus && ends[1] === minus;
  const ports = parts[side].some(isSame) ? parts[side].filter((ends) => !isSame(ends)) : [...parts[side], [plus, minus]];
  return plus === minus ? parts : { ...parts, [side]: ports };
};
