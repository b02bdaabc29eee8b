// Five short steps through the points of the paper. Each loads a case and asks a question of it.
export interface Step {
  title: string;
  text: string;
  example: string;
  /** Changes the text of the example. */
  change?: (text: string) => string;
  verb: string;
  options?: Record<string, string>;
}

export const TOUR: Step[] = [
  {
    title: "The crush plane divides the energy",
    text: "A sedan hits the side of a pickup. Turn the crush plane Γ: the work of the normal impulse W_n and that of the tangential impulse W_t change at once, while their sum, the energy loss T_L, stays. At e = 0 and μ = μ0 the vehicles end with a common velocity at the contact, whatever plane the impulse is resolved in.",
    example: "position-a.toml",
    verb: "sweep",
    options: { vary: "contact.crush_plane=-10 deg:10 deg:1 deg", of: "W_n, W_t, T_L" },
  },
  {
    title: "The loss peaks at e = 0, μ = μ0",
    text: "Vary the share of the critical impulse ratio: the energy loss is greatest where the contact stops sliding just at separation. Less friction dissipates less, and so does more than the critical impulse.",
    example: "position-a.toml",
    change: (text) => text.replace(/^restitution = .*$/m, "restitution = 0\nimpulse_ratio = { of_critical = 1 }"),
    verb: "sweep",
    options: { vary: "contact.impulse_ratio.of_critical=0:1:0.05", of: "T_L, W_n, W_t" },
  },
  {
    title: "A sideswipe does not reach a common velocity",
    text: "Here the vehicles slide past each other: the impulse ratio is given below its critical value, and the tangential velocity at the contact does not vanish. The impulse stays inside the cone of friction of the impulse plane.",
    example: "sideswipe.toml",
    verb: "solve",
  },
  {
    title: "Restitution takes energy back",
    text: "Raise e: the normal impulse grows by the factor 1 + e, ΔV with it, and the energy loss falls. For crashes at the speeds of the paper, e is a tenth or two.",
    example: "position-a.toml",
    verb: "sweep",
    options: { vary: "contact.restitution=0:0.3:0.02", of: "dV1, dV2, T_L" },
  },
  {
    title: "CRASH3 beside planar mechanics",
    text: "CRASH3 finds ΔV from crush energy alone: a common velocity, a correction for the direction of force, and masses reduced by the lever arm. Planar mechanics from the same energy stands beside it, and the table prices each assumption.",
    example: "cavalier-crush.toml",
    verb: "crash3",
  },
];
