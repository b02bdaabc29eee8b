"""What each verb returns: a class for every object of its JSON, with its units. Written by `tools/answers.py` from `schemas/`.

A key that may be missing is ``None`` as an attribute, or an empty list; with brackets it raises :class:`KeyError`.
"""

from __future__ import annotations

from functools import partial
from typing import Any, Literal

from ._answer import Answer, Facts

__all__ = [
    "Accelerated",
    "Alternative",
    "AtImpact",
    "AtTime",
    "Barrier",
    "Bounds",
    "Bracket",
    "Braking",
    "ChannelAnswer",
    "CheckFinding",
    "CheckReport",
    "CheckedRecord",
    "Clipped",
    "ClippedSensor",
    "Comparison",
    "ComparisonReconstruction",
    "ComparisonVehicle",
    "ComplianceMatrix",
    "Components",
    "Contact",
    "Cost",
    "Covariance",
    "Crash3",
    "CrushAnswer",
    "Definition",
    "Density",
    "Derivatives",
    "Derived",
    "Diagnostic",
    "Draws",
    "End",
    "Energy",
    "EnergyBounds",
    "Evidence",
    "FigureEntry",
    "Film",
    "Fit",
    "Follows",
    "Forms",
    "Formula",
    "FormulaInput",
    "FurthestOff",
    "Gradient",
    "Guaranteed",
    "Impulse",
    "ImpulsePlane",
    "Interval",
    "Kinematics",
    "LinePoint",
    "Linear",
    "Miss",
    "MonteCarlo",
    "Motion",
    "NoticeEntry",
    "OfVehicle",
    "OutputUncertainty",
    "PairDensity",
    "Peak",
    "Planar",
    "PlaneImpulse",
    "PointFit",
    "Pooled",
    "PooledNumber",
    "Posterior",
    "PosteriorDensity",
    "PreCrash",
    "Predicted",
    "Probability",
    "ProfileLevel",
    "Reconstruction",
    "ReconstructionComparison",
    "ReconstructionReconstruction",
    "ReconstructionSolution",
    "ReconstructionVehicle",
    "RecordAnswer",
    "Recorder",
    "Records",
    "RefusedSamples",
    "Residuals",
    "RestPose",
    "SecondOrder",
    "SeparationFromRest",
    "ShapleyEffect",
    "Share",
    "Skid",
    "SlideFit",
    "Slides",
    "Solution",
    "State",
    "StiffnessAnswer",
    "Summary",
    "Sweep",
    "Test",
    "Trace",
    "Uncertain",
    "UncertainNumber",
    "Uncertainty",
    "Unknown",
    "Vehicle",
    "VehicleCrush",
    "VehicleSlide",
    "VelocityChange",
    "Zone",
]


class Components(Facts[Any]):
    """A velocity in the axes of the contact."""

    __slots__ = ()

    normal: float
    """Along the normal, in m/s."""
    tangential: float
    """Along the tangent, in m/s."""


class Impulse(Facts[Any]):
    """The impulse on vehicle 1."""

    __slots__ = ()

    moment: float | None
    """The moment impulse in N m s, where the case has one."""
    normal: float
    """Along the normal, in N s."""
    tangential: float
    """Along the tangent, in N s."""
    x: float
    """Along x, in N s."""
    y: float
    """Along y, in N s."""


class PlaneImpulse(Facts[Any]):
    """An impulse on vehicle 1 in the axes of the contact."""

    __slots__ = ()

    normal: float
    """Along the normal, in N s."""
    tangential: float
    """Along the tangent, in N s."""


class ComplianceMatrix(Facts[Any]):
    """The compliance at the impact center, in 1/kg."""

    __slots__ = ()

    coupling: float
    """K_nt: change of the tangential velocity by a normal impulse, and the reverse."""
    normal: float
    """K_nn: change of the normal velocity by a normal impulse."""
    tangential: float
    """K_tt: change of the tangential velocity by a tangential impulse."""


class ImpulsePlane(Facts[Any]):
    """Routh's construction in the plane of the impulse P on vehicle 1. An impulse changes the relative velocity at the impact center
    by K P, so that each event is a line: ``compliance.normal`` P_n + ``compliance.coupling`` P_t has a given value, or
    ``compliance.coupling`` P_n + ``compliance.tangential`` P_t. A moment impulse shifts the lines."""

    __slots__ = ()
    _parts = {"brach": PlaneImpulse, "common_velocity": PlaneImpulse, "compliance": ComplianceMatrix, "kudlich_slibar": PlaneImpulse}

    brach: PlaneImpulse
    """The sticking impulse of Brach's law, where sliding ends at termination; its ratio is the critical one."""
    common_velocity: PlaneImpulse
    """The impulse to a common velocity, where sliding ends at maximum compression."""
    compliance: ComplianceMatrix
    """The compliance K at the impact center."""
    kudlich_slibar: PlaneImpulse
    """The sticking impulse of Kudlich and Slibar's law, where restitution holds for both components."""
    maximum_compression: float
    """Normal component of K P on the line of maximum compression, where the relative normal velocity is zero, in m/s."""
    sliding_end: float
    """Tangential component of K P on the line where sliding ends, the relative tangential velocity being zero, in m/s."""
    termination: float
    """Normal component of K P on the line of termination, where restitution holds, in m/s."""


class EnergyBounds(Facts[Any]):
    """Up to where no energy is gained."""

    __slots__ = ()

    greatest_impulse_ratio: float | None
    """The greatest impulse ratio at this restitution; ``null`` if any."""
    least_impulse_ratio: float | None
    """The least impulse ratio at this restitution; ``null`` if any."""
    restitution: float
    """The greatest restitution for this approach velocity."""
    restitution_for_any_approach: float
    """The greatest restitution for any approach velocity of this contact."""


class Contact(Facts[Any]):
    """The contact of the two vehicles."""

    __slots__ = ()
    _parts = {"approach": Components, "impulse": Impulse, "impulse_plane": ImpulsePlane, "no_energy_gain": EnergyBounds, "separation": Components}

    approach: Components
    """Relative velocity at the impact center before, in m/s."""
    critical_impulse_ratio: float | None
    """Critical impulse ratio μ₀, that of Brach's law whichever is in force; ``null`` where the impulse that ends sliding has no
    normal part."""
    crush_plane: float
    """Angle Γ of the crush plane in rad, as the case gives it."""
    impulse: Impulse
    """The impulse on vehicle 1 in N s."""
    impulse_plane: ImpulsePlane | None
    """The lines and points of Routh's construction; absent where momentum alone determines the impulse."""
    impulse_ratio: float
    """Impulse ratio μ."""
    impulse_ratio_given: Literal["critical", "number", "of-critical", "friction"]
    """The form in which the case gives the impulse ratio."""
    impulse_ratio_parameter: float | None
    """The number that it is given by; ``null`` at the critical ratio."""
    model: str | None
    """``momentum`` where momentum alone determines the impulse: the normal is then along it."""
    no_energy_gain: EnergyBounds | None
    """Limits of restitution and impulse ratio without a gain of energy; ``null`` with a moment impulse."""
    restitution: float | None
    """Coefficient of restitution e; ``null`` where momentum alone leaves no approach along the impulse."""
    separation: Components
    """Relative velocity at the impact center after, in m/s."""
    tangential_law: Literal["brach", "kudlich-slibar"]
    """The law of the tangential impulse."""


class End(Facts[Any]):
    """One end of the bracket."""

    __slots__ = ()
    _parts = {"outputs": Facts}

    crush_plane: float
    """Angle of the crush plane in rad."""
    outputs: Facts[float | None] | None
    """The outputs there; ``null`` if the collision is refused."""
    refused: str | None
    """Reason why the collision is refused there."""


class Bracket(Facts[Any]):
    """The bracket of the crush plane between the two surfaces in contact."""

    __slots__ = ()
    _parts = {"d": Facts, "lower": End, "upper": End}

    d: Facts[float | None]
    """Derivatives with respect to the crush plane at its nominal angle, in SI per rad."""
    lower: End
    """At its lower end."""
    upper: End
    """At its upper end."""


class Energy(Facts[Any]):
    """Energies of both vehicles in J."""

    __slots__ = ()

    after: float
    """Kinetic energy after the impact."""
    before: float
    """Kinetic energy before the impact."""
    loss: float
    """Energy loss T_L."""
    loss_share: float | None
    """The loss as a share of the energy before; ``null`` if there was none."""
    moment_work: float | None
    """Work W_m of the moment impulse, where the case has one."""
    normal_work: float
    """Work W_n of the normal impulse; negative where energy is lost."""
    tangential_work: float
    """Work W_t of the tangential impulse; negative where energy is lost."""


class FigureEntry(Facts[Any]):
    """FigureEntry."""

    __slots__ = ()

    measure: str
    """The quantity that the number measures, such as ``speed``."""
    value: float
    """Its value in SI; angles in radians."""


class NoticeEntry(Facts[Any]):
    """A notice in JSON."""

    __slots__ = ()
    _parts = {"figures": FigureEntry}

    code: str
    """A stable code, such as ``unit-assumed``."""
    figures: list[FigureEntry]
    """The numbers in the sentence, in order."""
    path: str
    """The path in the case file that it refers to; empty if it refers to the whole case."""
    severity: Literal["note", "warning"]
    text: str
    """The sentence in SI."""


class Motion(Facts[Any]):
    """A motion."""

    __slots__ = ()

    velocity: list[float]
    """Velocity along x and y, in m/s."""
    yaw_rate: float
    """Yaw rate in rad/s."""


class Skid(Facts[Any]):
    """The motion over a skid."""

    __slots__ = ()

    deceleration: float
    """Deceleration along the road, in m/s²."""
    end: float
    """Speed at its end, in m/s."""
    start: float
    """Speed at its start, in m/s."""
    time: float
    """Duration in s."""


class Braking(Facts[Any]):
    """The braking of a vehicle before the impact."""

    __slots__ = ()
    _parts = {"skids": Skid}

    distance: float
    """Distance of the skids, as on a plan, and of the reaction before them, in m."""
    impact_speed: float
    """Speed at the impact, in m/s."""
    reaction_distance: float | None
    """Distance covered in the reaction time, in m."""
    skids: list[Skid]
    """The skids, in their order along the road."""
    speed: float
    """Speed when it began to brake, in m/s."""
    time: float
    """Time from the perception, or without a reaction time from the first skid, to the impact, in s."""


class Crash3(Facts[Any]):
    """Results of CRASH3 for a vehicle."""

    __slots__ = ()

    corrected_energy: float
    """Corrected crush energy in J."""
    correction: float
    """Energy correction factor 1 + tan² α."""
    delta_v_magnitude: float
    """ΔV in m/s."""
    effective_mass_factor: float
    """Effective mass factor γ."""
    pdof: float
    """Principal direction of force that it takes, in rad."""


class Vehicle(Facts[Any]):
    """A vehicle before and after the impact; zeros for a barrier."""

    __slots__ = ()
    _parts = {"before": Motion, "braking": Braking, "crash3": Crash3}

    barrier: bool
    """``true`` for a fixed barrier."""
    before: Motion
    """Its motion before the impact."""
    braking: Braking | None
    """Its braking before the impact, where the case has its skids."""
    crash3: Crash3 | None
    """Results of CRASH3, where every vehicle has its crush."""
    crush_energy: float | None
    """Crush energy in J, where the case has the crush of this vehicle."""
    delta_v: list[float]
    """Change of velocity along x and y, in m/s."""
    delta_v_magnitude: float
    """Magnitude of the change of velocity, in m/s."""
    equivalent_energy_speed: float | None
    """Speed at which the crush energy is the vehicle's kinetic energy, in m/s."""
    mean_depth: float | None
    """Mean depth of the crush in m."""
    name: str
    """Its name."""
    pdof: float
    """Principal direction of force, clockwise from straight ahead, in rad."""
    velocity: list[float]
    """Velocity after the impact along x and y, in m/s."""
    yaw_rate: float | None
    """Yaw rate after the impact, in rad/s; ``null`` where momentum alone does not determine it."""


class Solution(Answer):
    """An answer in SI and radians: the facts of a verb, with title and notices."""

    __slots__ = ()
    _parts = {"contact": Contact, "crush_plane_bracket": Bracket, "energy": Energy, "messages": NoticeEntry, "vehicles": Vehicle}

    contact: Contact
    """The contact."""
    crush_plane_bracket: Bracket | None
    """Outputs at both ends of the crush plane's bracket, where the case gives the surfaces that meet."""
    energy: Energy
    """The energies."""
    messages: list[NoticeEntry]
    """The same with code, severity, path and figures."""
    notes: list[str]
    """Notes and warnings as sentences in SI; omitted if there are none."""
    schema: int
    """The version of this document."""
    title: str
    """The title of the file; empty if it has none."""
    vehicles: list[Vehicle]
    """Vehicle 1 and vehicle 2."""


class Derivatives(Facts[Any]):
    """An output with its derivatives; one that does not exist, as that of a magnitude at zero, is ``null``. A warning tells where
    friction begins to hold, and they are those of one side."""

    __slots__ = ()
    _parts = {"d": Facts, "d2": partial(Facts, part=Facts)}

    d: Facts[float | None]
    """Its derivative with respect to each input."""
    d2: Facts[Facts[float | None]] | None
    """Its second derivatives with respect to each pair of inputs, if requested."""
    value: float | None
    """Its value."""


class Gradient(Answer):
    """An answer in SI and radians: the facts of a verb, with title and notices."""

    __slots__ = ()
    _parts = {"messages": NoticeEntry, "of": partial(Facts, part=Derivatives), "wrt": Facts}

    messages: list[NoticeEntry]
    """The same with code, severity, path and figures."""
    notes: list[str]
    """Notes and warnings as sentences in SI; omitted if there are none."""
    of: Facts[Derivatives]
    """Each output with its derivatives."""
    outputs_of_case: int
    """Number of outputs of the case."""
    schema: int
    """The version of this document."""
    title: str
    """The title of the file; empty if it has none."""
    wrt: Facts[float | None]
    """The value of each input; ``null`` for the impulse ratio where the file does not give it."""


class Sweep(Answer):
    """An answer in SI and radians: the facts of a verb, with title and notices."""

    __slots__ = ()
    _parts = {"messages": NoticeEntry, "of": Facts, "vary": Facts}

    messages: list[NoticeEntry]
    """The same with code, severity, path and figures."""
    notes: list[str]
    """Notes and warnings as sentences in SI; omitted if there are none."""
    of: Facts[list[float | None]]
    """The outputs at each point; ``null`` if the point is refused."""
    refusal: list[str | None]
    """The codes of these reasons, joined by ``;``."""
    refused: list[str | None]
    """Reason why a point is refused; ``null`` if it is not."""
    schema: int
    """The version of this document."""
    title: str
    """The title of the file; empty if it has none."""
    vary: Facts[list[float]]
    """The values of the inputs at each point, the last range running fastest."""


class Zone(Facts[Any]):
    """A zone of a crush."""

    __slots__ = ()

    A: float | None
    """A = d0 d1 in N/m."""
    B: float | None
    """B = d1² in N/m²."""
    G: float | None
    """G = d0²/2 in N."""
    K: list[float]
    """Moments K1, K2, K3 of its part of the profile."""
    crush_energy: float
    """Its crush energy in J."""
    d0: float | None
    """d0 in √N."""
    d1: float | None
    """d1 in √N/m."""
    to: float | None
    """Its end, in m from the first station; ``null`` for the last zone."""
    width: float
    """Its width in m."""


class VehicleCrush(Facts[Any]):
    """The crush of a vehicle."""

    __slots__ = ()
    _parts = {"zones": Zone}

    A: float | None
    """A = d0 d1 in N/m."""
    B: float | None
    """B = d1² in N/m²."""
    G: float | None
    """G = d0²/2 in N."""
    K: list[float]
    """Moments K1, K2, K3 of the profile, in m, m², m³."""
    barrier: bool
    """``true`` if it is a fixed barrier."""
    crush_energy: float
    """Crush energy E_C in J."""
    crush_force: float | None
    """Force normal to the surface at the end of the crush, the integral of A + B C over the width, in N; ``null`` without crush."""
    crush_force_at_pdof: float | None
    """The force along the PDOF, in N: ``crush_force`` over the cosine of the angle; ``null`` if the force does not point into the
    surface."""
    d0: float | None
    """d0 in √N."""
    d1: float | None
    """d1 in √N/m."""
    depths: int
    """Number of measured depths."""
    equivalent_energy_speed: float
    """Speed at which the crush energy is the vehicle's kinetic energy, in m/s."""
    form_factor: float | None
    """Form factor: the mean of the squared depths over the square of their mean, 1 for a uniform crush; ``null`` without crush."""
    mean_depth: float
    """Mean depth in m."""
    name: str
    """The name of the vehicle."""
    pdof: float | None
    """Principal direction of force in rad that ``crush_force_at_pdof`` is for: that of the file, or of the common-velocity impulse;
    ``null`` if neither is known."""
    saturation: float | None
    """Depth beyond which the force is constant, in m, if the file gives one."""
    surface: str | None
    """The surface from whose perpendicular the angle of the force is taken; ``null`` without ``pdof``."""
    width: float
    """Width w of the crush in m."""
    zones: list[Zone]
    """The zones along the width, if there are several."""


class CrushAnswer(Answer):
    """An answer in SI and radians: the facts of a verb, with title and notices."""

    __slots__ = ()
    _parts = {"messages": NoticeEntry, "vehicles": VehicleCrush}

    force_imbalance: float | None
    """By how much the larger of the forces at the PDOF exceeds the smaller, as a share of the smaller: 0 by Newton's third law, and
    at most 1 by EDCRASH's diagnostics; ``null`` unless both are known."""
    messages: list[NoticeEntry]
    """The same with code, severity, path and figures."""
    names: list[str]
    """The names of the vehicles."""
    notes: list[str]
    """Notes and warnings as sentences in SI; omitted if there are none."""
    schema: int
    """The version of this document."""
    title: str
    """The title of the file; empty if it has none."""
    vehicles: list[VehicleCrush | None]
    """The crush of each vehicle; ``null`` for a vehicle without crush, zeros for a barrier."""


class Cost(Facts[Any]):
    """The difference from planar mechanics."""

    __slots__ = ()

    delta_v_magnitude: list[float]
    """Difference of each ΔV, in m/s."""
    delta_v_share: list[float | None]
    """Difference of each ΔV as a fraction of it; ``null`` for a barrier."""
    loss: float
    """Difference of the energy loss, in J."""
    loss_share: float | None
    """Difference of the energy loss as a fraction of it; ``null`` without a loss."""


class Follows(Facts[Any]):
    """A result, and its difference from planar mechanics."""

    __slots__ = ()
    _parts = {"cost": Cost}

    assumption: str | None
    """The assumption in words."""
    cost: Cost
    """The change caused by the assumption."""
    delta_v_magnitude: list[float]
    """ΔV of each vehicle in m/s."""
    loss: float
    """Energy loss T_L in J."""


class Planar(Facts[Any]):
    """Results from the crush energy of both vehicles."""

    __slots__ = ()
    _parts = {"common_velocity": Follows, "planar": Follows, "point_mass": Follows, "tangential_factor": Follows, "together": Follows}

    barriers: list[bool]
    """``true`` for each of vehicle 1 and vehicle 2 that is a fixed barrier."""
    common_velocity: Follows
    """Planar mechanics with CRASH3's common velocity alone."""
    crush_energy: float
    """The crush energy of both vehicles in J."""
    planar: Follows
    """Planar mechanics."""
    point_mass: Follows
    """Planar mechanics with CRASH3's point mass alone."""
    tangential_factor: Follows
    """Planar mechanics with CRASH3's tangential factor alone."""
    together: Follows
    """Planar mechanics with all three assumptions."""


class ComparisonReconstruction(Facts[Any]):
    """Approach velocity reconstructed from a separation velocity."""

    __slots__ = ()

    approach_velocity: list[float]
    """Approach velocity along x and y by CRASH3, in m/s."""
    separation_velocity: list[float]
    """Separation velocity along x and y, in m/s."""


class ComparisonVehicle(Facts[Any]):
    """CRASH3 results for a vehicle; zeros for a barrier."""

    __slots__ = ()
    _parts = {"reconstruction": ComparisonReconstruction}

    approach_velocity: list[float]
    """Approach velocity of the case along x and y, in m/s."""
    barrier: bool
    """``true`` if it is a fixed barrier."""
    corrected_energy: float
    """Corrected crush energy in J."""
    correction: float
    """Energy correction factor 1 + tan² α."""
    crush_energy: float
    """Crush energy in J."""
    delta_v: list[float]
    """ΔV along x and y, in m/s."""
    delta_v_magnitude: float
    """ΔV in m/s."""
    effective_mass_factor: float
    """Effective mass factor γ."""
    moment_arm: float
    """Moment arm of the force about the center of mass, in m."""
    name: str
    """Its name."""
    pdof: float
    """Principal direction of force in rad, clockwise from straight ahead."""
    reconstruction: ComparisonReconstruction | None
    """Approach velocity computed from the separation velocity; ``null`` if neither the evidence nor planar mechanics gives one."""
    surface: str | None
    """The crushed surface: ``front``, ``right``, ``rear`` or ``left``; ``null`` for a barrier."""


class Comparison(Answer):
    """An answer in SI and radians: the facts of a verb, with title and notices."""

    __slots__ = ()
    _parts = {"messages": NoticeEntry, "planar": Planar, "vehicles": ComparisonVehicle}

    corrected_energy: float | None
    """Sum of the corrected crush energies, in J."""
    impulse: float | None
    """The impulse between them, in N s."""
    messages: list[NoticeEntry]
    """The same with code, severity, path and figures."""
    notes: list[str]
    """Notes and warnings as sentences in SI; omitted if there are none."""
    planar: Planar | None
    """Both methods from the same crush energy; ``null`` if planar mechanics refuses the case."""
    schema: int
    """The version of this document."""
    title: str
    """The title of the file; empty if it has none."""
    vehicles: list[ComparisonVehicle]
    """Vehicle 1 and vehicle 2."""


class ReconstructionVehicle(Facts[Any]):
    """CRASH3 results for a vehicle; zeros for a barrier."""

    __slots__ = ()
    _parts = {"reconstruction": ComparisonReconstruction}

    approach_velocity: list[float]
    """Approach velocity of the case along x and y, in m/s."""
    barrier: bool
    """``true`` if it is a fixed barrier."""
    corrected_energy: float
    """Corrected crush energy in J."""
    correction: float
    """Energy correction factor 1 + tan² α."""
    crush_energy: float
    """Crush energy in J."""
    delta_v: list[float]
    """ΔV along x and y, in m/s."""
    delta_v_magnitude: float
    """ΔV in m/s."""
    effective_mass_factor: float
    """Effective mass factor γ."""
    moment_arm: float
    """Moment arm of the force about the center of mass, in m."""
    name: str
    """Its name."""
    pdof: float
    """Principal direction of force in rad, clockwise from straight ahead."""
    reconstruction: ComparisonReconstruction | None
    """Approach velocity computed from the separation velocity; ``null`` if neither the evidence nor planar mechanics gives one."""
    surface: str | None
    """The crushed surface: ``front``, ``right``, ``rear`` or ``left``; ``null`` for a barrier."""


class ReconstructionComparison(Facts[Any]):
    """CRASH3 beside planar mechanics."""

    __slots__ = ()
    _parts = {"planar": Planar, "vehicles": ReconstructionVehicle}

    corrected_energy: float | None
    """Sum of the corrected crush energies, in J."""
    impulse: float | None
    """The impulse between them, in N s."""
    planar: Planar | None
    """Both methods from the same crush energy; ``null`` if planar mechanics refuses the case."""
    vehicles: list[ReconstructionVehicle]
    """Vehicle 1 and vehicle 2."""


class Interval(Facts[Any]):
    """An interval of an unknown, or of what follows from the unknowns."""

    __slots__ = ()

    high: float | None
    """Its upper end; ``null`` if nothing limits it."""
    high_limited_by: str | None
    """The same of the upper end."""
    level: float
    """The probability with which such intervals contain the true value."""
    low: float | None
    """Its lower end; ``null`` if nothing limits it."""
    low_limited_by: str | None
    """The bound of another unknown, or the limit of the physics, that makes the lower end; ``null`` if the evidence does."""
    method: str
    """``profile``: the range over which the best fit of everything else stays within a quantile of chi-square of the least one."""
    narrows: bool
    """``true`` if it is narrower than the range that the bounds of the quantity alone allow, or than a whole turn."""


class PosteriorDensity(Facts[Any]):
    """The share of the draws in bins of equal width."""

    __slots__ = ()

    edges: list[float]
    """Edges of the bins from the least draw to the greatest, one more than bins."""
    shares: list[float]
    """The share of the draws in each; they add up to 1."""


class Posterior(Facts[Any]):
    """The posterior of one quantity."""

    __slots__ = ()
    _parts = {"density": PosteriorDensity, "quantiles": Facts}

    density: PosteriorDensity | None
    """The density of the draws; ``null`` where they do not vary."""
    ess: float | None
    """Number of independent draws that would know the middle and the tails as well; ``null`` where they do not vary."""
    hdi: list[float]
    """The shortest range that has the probability of the intervals."""
    mean: float
    """The mean."""
    median: float
    """The median."""
    quantiles: Facts[float]
    """Values below which a share of the draws lies, by that share."""
    r_hat: float | None
    """R-hat, split and of ranks: the draws have converged where it is below 1.01; ``null`` where they do not vary."""
    sd: float
    """The standard deviation."""


class ProfileLevel(Facts[Any]):
    """The values at which the profile of the likelihood reaches a height."""

    __slots__ = ()

    chi_square: float
    """Its height: chi-square of the best fit of everything else, above the least one."""
    high: float | None
    """The same above it."""
    level: float
    """The level of confidence of the interval between the two."""
    low: float | None
    """The value below the best one; ``null`` if nothing limits it. A bound or a limit of the physics has one value for all heights
    beyond."""


class Derived(Facts[Any]):
    """What follows from the unknowns, in the best solution."""

    __slots__ = ()
    _parts = {"interval": Interval, "posterior": Posterior, "profile": ProfileLevel}

    interval: Interval
    """The range that the evidence, all bounds and the physics allow."""
    posterior: Posterior | None
    """Its posterior, on request."""
    profile: list[ProfileLevel] | None
    """The profile of the likelihood, outwards, on request."""
    sd: float | None
    """Its standard deviation, from those of the unknowns; ``null`` if one of them has none."""
    value: float | None
    """Its value; ``null`` if the evidence leaves an unknown open."""


class Diagnostic(Facts[Any]):
    """A figure of the best solution compared with what crash tests and programs lead one to expect, in SI."""

    __slots__ = ()
    _parts = {"limit": Facts}

    figure: float | None
    """The figure; ``null`` if there is nothing to compare."""
    limit: Literal["same_sign"] | Facts[float] | Facts[list[float]]
    """Its expected limit."""
    meaning: str
    """Interpretation of the figure."""
    name: str
    """Its subject."""
    reading: Literal["within", "outside", "not checked"]
    """Position of the figure relative to its limit."""
    source: str
    """Source of the limit."""


class Evidence(Facts[Any]):
    """A piece of evidence compared with a solution."""

    __slots__ = ()

    computed: float
    """Its value in the solution."""
    given: float
    """Its value in the file."""
    sd: float | None
    """Its standard deviation; ``null`` if it is exact."""
    standardised_residual: float | None
    """Given minus computed, in standard deviations. Of separations from rest on locked wheels what the ways differ by."""


class FurthestOff(Facts[Any]):
    """The piece of evidence, or the prior, with the largest standardised residual."""

    __slots__ = ()

    computed: float
    """Its value in the solution."""
    given: float
    """Its value in the file."""
    name: str
    """Its name."""
    sd: float | None
    """Its standard deviation; ``null`` if it is exact."""
    standardised_residual: float | None
    """Given minus computed, in standard deviations. Of separations from rest on locked wheels what the ways differ by."""


class Alternative(Facts[Any]):
    """One of several solutions."""

    __slots__ = ()
    _parts = {"sd": Facts, "unknown": Facts}

    chi_square: float
    """Its chi-square."""
    degrees_of_freedom: int
    """Number of pieces of evidence minus number of unknowns."""
    probability: float
    """Probability that chi-square is larger by chance."""
    sd: Facts[float | None]
    """Their standard deviations."""
    searches: int
    """Number of searches that ended there."""
    unknown: Facts[float]
    """The unknowns."""


class PairDensity(Facts[Any]):
    """The share of the draws in each cell of a grid, whose columns and rows are the bins of two unknowns."""

    __slots__ = ()

    shares: list[list[float]]
    """The shares of each row, the least values first; all of them add up to 1."""
    x: str
    """The unknown whose bins are the columns."""
    y: str
    """The unknown whose bins are the rows."""


class Draws(Facts[Any]):
    """The draws of the posterior."""

    __slots__ = ()
    _parts = {"pairs": PairDensity, "values": Facts}

    chains: int
    """Number of chains."""
    draws: int
    """Number of draws of each chain."""
    ess: float | None
    """The least number of independent draws of an unknown or of a derived quantity; ``null`` if none varies."""
    pairs: list[PairDensity]
    """The joint density of each pair of the unknowns listed under ``[unknown]``."""
    r_hat: float | None
    """The greatest R-hat of an unknown or of a derived quantity; ``null`` if none varies."""
    seed: int
    """The seed of the draws."""


class PointFit(Facts[Any]):
    """A point along the path, beside the place of the path that is nearest to it in standard deviations."""

    __slots__ = ()

    computed: list[float]
    """The nearest place of the path, in m."""
    given: list[float]
    """Its place along x and y in the file, in m."""
    is_end: bool
    """``true`` if the nearest place is an end of the path."""
    sd: list[float]
    """Its standard deviations along x and y, in m."""
    standardised_residual: float
    """Distance from the path in standard deviations, positive where the point is to the left of the path."""
    time: float
    """The time since separation of the vehicle there, in s."""
    wheel: str | None
    """The wheel that passed it; ``null`` for the center of mass."""


class SlideFit(Facts[Any]):
    """How a slide fits the rest position, and the points along its path."""

    __slots__ = ()
    _parts = {"points": PointFit}

    chi_square: float
    """The sum of the squares of what pose and points are missed by, in standard deviations."""
    degrees_of_freedom: int
    """The number of points."""
    heading: float
    """Computed less given heading at rest, in rad."""
    points: list[PointFit]
    """Points along the path, in the order of the file."""
    position: list[float]
    """Computed less given position at rest, along x and y, in m."""
    probability: float
    """Probability that chi-square is larger by chance; 1 without points."""


class SeparationFromRest(Facts[Any]):
    """The separation of a vehicle, from where it came to rest."""

    __slots__ = ()
    _parts = {"fit": SlideFit}

    fit: SlideFit | None
    """How the slide fits the evidence; ``null`` for the closed form."""
    sd: list[float]
    """Standard deviations of both components of the velocity and of the yaw rate."""
    vehicle: int
    """The number of the vehicle, 1 or 2."""
    velocity: list[float]
    """Its velocity at separation along x and y, in m/s."""
    yaw_rate: float
    """Its yaw rate at separation, in rad/s."""


class ReconstructionSolution(Facts[Any]):
    """An answer in SI and radians: the facts of a verb, with title and notices."""

    __slots__ = ()
    _parts = {"contact": Contact, "crush_plane_bracket": Bracket, "energy": Energy, "messages": NoticeEntry, "vehicles": Vehicle}

    contact: Contact
    """The contact."""
    crush_plane_bracket: Bracket | None
    """Outputs at both ends of the crush plane's bracket, where the case gives the surfaces that meet."""
    energy: Energy
    """The energies."""
    messages: list[NoticeEntry]
    """The same with code, severity, path and figures."""
    notes: list[str]
    """Notes and warnings as sentences in SI; omitted if there are none."""
    schema: int
    """The version of this document."""
    title: str
    """The title of the file; empty if it has none."""
    vehicles: list[Vehicle]
    """Vehicle 1 and vehicle 2."""


class Guaranteed(Facts[Any]):
    """The guaranteed range of an unknown: outside of it nothing meets the evidence, whatever the rounding."""

    __slots__ = ()
    _parts = {"at_high": Facts, "at_low": Facts}

    at_high: Facts[float]
    """The unknowns where the greatest value is attained."""
    at_low: Facts[float]
    """The unknowns where the least value is attained."""
    bounds_sd: float
    """Standard deviations within which evidence and priors without limits are taken to be."""
    high: float
    """No value that meets the evidence is above it."""
    high_attained: float
    """The greatest value that was found to meet it."""
    is_tight: bool
    """``true`` if both ends are attained to within a millionth."""
    low: float
    """No value that meets the evidence is below it."""
    low_attained: float
    """The least value that was found to meet it."""


class Unknown(Facts[Any]):
    """An unknown in the best solution."""

    __slots__ = ()
    _parts = {"guaranteed": Guaranteed, "interval": Interval, "posterior": Posterior, "profile": ProfileLevel}

    at_bound: str | None
    """``min`` or ``max`` if it lies on a bound."""
    guaranteed: Guaranteed | None
    """Its guaranteed range, on request."""
    interval: Interval
    """The range that the evidence, all bounds and the physics allow; without ends if none could be found."""
    is_input: bool
    """``true`` if it is an uncertain input of a vehicle or of the contact, and not listed under ``[unknown]``."""
    max: float | None
    """Its upper bound in the file."""
    min: float | None
    """Its lower bound in the file."""
    posterior: Posterior | None
    """Its posterior, on request."""
    profile: list[ProfileLevel] | None
    """The profile of the likelihood, outwards, on request."""
    sd: float | None
    """Its standard deviation; ``null`` if there is none, as with exact evidence or at a bound."""
    value: float | None
    """Its value; ``null`` if the evidence does not determine it."""


class ReconstructionReconstruction(Facts[Any]):
    """A collision found from evidence, in SI and radians."""

    __slots__ = ()
    _parts = {"correlation": partial(Facts, part=Facts), "covariance": partial(Facts, part=Facts), "crash3": ReconstructionComparison, "derived": partial(Facts, part=Derived), "diagnostics": Diagnostic, "evidence": partial(Facts, part=Evidence), "furthest_off": FurthestOff, "influence": partial(Facts, part=Facts), "open_directions": Facts, "other_minima": Alternative, "posterior": Draws, "priors": partial(Facts, part=Evidence), "probabilities": Facts, "separations": SeparationFromRest, "solution": ReconstructionSolution, "solutions": Alternative, "unknown": partial(Facts, part=Unknown), "without_bounds": Alternative, "worse": Alternative}

    by_other_separations: list[ReconstructionReconstruction]
    """The answers from the other separations that lead to the same rest positions, the best first."""
    chi_square: float
    """Sum of the squares of the standardised residuals."""
    converged: bool
    """``true`` if a search converged; otherwise there is no answer."""
    correlation: Facts[Facts[float | None]]
    """Correlation of the unknowns."""
    covariance: Facts[Facts[float | None]]
    """Covariance of the unknowns; ``null`` where an unknown has no standard deviation."""
    crash3: ReconstructionComparison | None
    """CRASH3 results from the same evidence."""
    degrees_of_freedom: int
    """Number of pieces of evidence minus number of unknowns."""
    derived: Facts[Derived]
    """What follows from the unknowns and is asked for most: ΔV and principal direction of force of each vehicle, closing speed,
    energies, impulse ratio, and equivalent energy speed of each vehicle where its share of the crush energy is known."""
    diagnostics: list[Diagnostic]
    """Diagnostics of the best solution: what users of crash programs ask next."""
    evidence: Facts[Evidence]
    """The evidence, compared with the best solution."""
    furthest_off: FurthestOff | None
    """The piece of evidence, or the prior, with the largest standardised residual in the best solution; ``null`` if all are exact."""
    hardly_determined: list[str]
    """Deprecated name of ``weakly_determined``."""
    impulse_ratio_is_fraction: bool
    """``true`` if ``contact.impulse_ratio`` is the fraction of the critical ratio, as the case gives it."""
    influence: Facts[Facts[float | None]]
    """Change of each unknown per unit of each piece of evidence; ``null`` if the unknown is not determined."""
    iterations: int
    """Number of steps of the search that found the best solution."""
    limits: list[str]
    """The limits of the physics that the best solution lies on, by the code of the refusal beyond them."""
    not_determined: list[str]
    """Combinations of unknowns that the evidence does not constrain, in words."""
    open_directions: list[Facts[float]]
    """The same as numbers: the change of each unknown along the combination."""
    other_minima: list[Alternative]
    """Other minima of chi-square, which the evidence distinguishes from the best one."""
    other_separations: bool
    """``true`` if other separations, which lead to the same rest positions, agree with the evidence too."""
    posterior: Draws | None
    """Draws from the posterior, on request."""
    priors: Facts[Evidence] | None
    """Prior values of unknowns, compared with the best solution."""
    probabilities: Facts[float] | None
    """The probability of each statement of the call."""
    probability: float
    """Probability that chi-square is larger by chance."""
    searches: int
    """Number of searches."""
    searches_at_solutions: list[int]
    """Number of searches that ended at each solution, the best first."""
    searches_converged: int
    """Number of searches that converged."""
    seed: int
    """The seed of the starts."""
    separations: list[SeparationFromRest]
    """The separations that are used, from rest positions and points along the paths; left out without ``[rest]``."""
    solution: ReconstructionSolution | None
    """The collision of the best solution; ``null`` where the evidence leaves an unknown open."""
    solutions: list[Alternative]
    """Every solution that fits the evidence; several only if the evidence cannot distinguish them."""
    starts: int
    """Maximum number of starts."""
    unknown: Facts[Unknown]
    """The unknowns."""
    verdict: str
    """``agrees``, ``several solutions``, ``undetermined``, ``contradicted`` or ``bounds exclude``."""
    weakly_determined: list[str]
    """Unknowns that the evidence barely constrains."""
    without_bounds: Alternative | None
    """The best fit without bounds, if it lies outside the bounds."""
    worse: list[Alternative]
    """Deprecated name of ``other_minima``."""


ReconstructionReconstruction._parts["by_other_separations"] = ReconstructionReconstruction


class Reconstruction(Answer):
    """An answer in SI and radians: the facts of a verb, with title and notices."""

    __slots__ = ()
    _parts = {"by_other_separations": ReconstructionReconstruction, "correlation": partial(Facts, part=Facts), "covariance": partial(Facts, part=Facts), "crash3": ReconstructionComparison, "derived": partial(Facts, part=Derived), "diagnostics": Diagnostic, "evidence": partial(Facts, part=Evidence), "furthest_off": FurthestOff, "influence": partial(Facts, part=Facts), "messages": NoticeEntry, "open_directions": Facts, "other_minima": Alternative, "posterior": Draws, "priors": partial(Facts, part=Evidence), "probabilities": Facts, "separations": SeparationFromRest, "solution": ReconstructionSolution, "solutions": Alternative, "unknown": partial(Facts, part=Unknown), "without_bounds": Alternative, "worse": Alternative}

    by_other_separations: list[ReconstructionReconstruction]
    """The answers from the other separations that lead to the same rest positions, the best first."""
    chi_square: float
    """Sum of the squares of the standardised residuals."""
    converged: bool
    """``true`` if a search converged; otherwise there is no answer."""
    correlation: Facts[Facts[float | None]]
    """Correlation of the unknowns."""
    covariance: Facts[Facts[float | None]]
    """Covariance of the unknowns; ``null`` where an unknown has no standard deviation."""
    crash3: ReconstructionComparison | None
    """CRASH3 results from the same evidence."""
    degrees_of_freedom: int
    """Number of pieces of evidence minus number of unknowns."""
    derived: Facts[Derived]
    """What follows from the unknowns and is asked for most: ΔV and principal direction of force of each vehicle, closing speed,
    energies, impulse ratio, and equivalent energy speed of each vehicle where its share of the crush energy is known."""
    diagnostics: list[Diagnostic]
    """Diagnostics of the best solution: what users of crash programs ask next."""
    evidence: Facts[Evidence]
    """The evidence, compared with the best solution."""
    furthest_off: FurthestOff | None
    """The piece of evidence, or the prior, with the largest standardised residual in the best solution; ``null`` if all are exact."""
    hardly_determined: list[str]
    """Deprecated name of ``weakly_determined``."""
    impulse_ratio_is_fraction: bool
    """``true`` if ``contact.impulse_ratio`` is the fraction of the critical ratio, as the case gives it."""
    influence: Facts[Facts[float | None]]
    """Change of each unknown per unit of each piece of evidence; ``null`` if the unknown is not determined."""
    iterations: int
    """Number of steps of the search that found the best solution."""
    limits: list[str]
    """The limits of the physics that the best solution lies on, by the code of the refusal beyond them."""
    messages: list[NoticeEntry]
    """The same with code, severity, path and figures."""
    not_determined: list[str]
    """Combinations of unknowns that the evidence does not constrain, in words."""
    notes: list[str]
    """Notes and warnings as sentences in SI; omitted if there are none."""
    open_directions: list[Facts[float]]
    """The same as numbers: the change of each unknown along the combination."""
    other_minima: list[Alternative]
    """Other minima of chi-square, which the evidence distinguishes from the best one."""
    other_separations: bool
    """``true`` if other separations, which lead to the same rest positions, agree with the evidence too."""
    posterior: Draws | None
    """Draws from the posterior, on request."""
    priors: Facts[Evidence] | None
    """Prior values of unknowns, compared with the best solution."""
    probabilities: Facts[float] | None
    """The probability of each statement of the call."""
    probability: float
    """Probability that chi-square is larger by chance."""
    schema: int
    """The version of this document."""
    searches: int
    """Number of searches."""
    searches_at_solutions: list[int]
    """Number of searches that ended at each solution, the best first."""
    searches_converged: int
    """Number of searches that converged."""
    seed: int
    """The seed of the starts."""
    separations: list[SeparationFromRest]
    """The separations that are used, from rest positions and points along the paths; left out without ``[rest]``."""
    solution: ReconstructionSolution | None
    """The collision of the best solution; ``null`` where the evidence leaves an unknown open."""
    solutions: list[Alternative]
    """Every solution that fits the evidence; several only if the evidence cannot distinguish them."""
    starts: int
    """Maximum number of starts."""
    title: str
    """The title of the file; empty if it has none."""
    unknown: Facts[Unknown]
    """The unknowns."""
    verdict: str
    """``agrees``, ``several solutions``, ``undetermined``, ``contradicted`` or ``bounds exclude``."""
    weakly_determined: list[str]
    """Unknowns that the evidence barely constrains."""
    without_bounds: Alternative | None
    """The best fit without bounds, if it lies outside the bounds."""
    worse: list[Alternative]
    """Deprecated name of ``other_minima``."""


class UncertainNumber(Facts[Any]):
    """An uncertain input."""

    __slots__ = ()

    mean: float | None
    """The mean of its distribution; ``null`` if it has none."""
    range: list[float | None]
    """The least and the greatest value that ``bounds`` takes; ``null`` where there is none."""
    sd: float | None
    """The standard deviation of its distribution; ``null`` if it has none, or an infinite one."""
    value: float
    """The value that a verb with one number uses."""


class Bounds(Facts[Any]):
    """The guaranteed range of an output: ``low`` is at most its least value, and that at most ``low_attained``; the same for the
    greatest."""

    __slots__ = ()
    _parts = {"at_high": Facts, "at_low": Facts}

    at_high: Facts[float]
    """The inputs at which the greatest value is found."""
    at_low: Facts[float]
    """The inputs at which the least value is found."""
    high: float | None
    """No value is greater; ``null`` if nothing is proven."""
    high_attained: float
    """The greatest value found."""
    is_tight: bool
    """Whether the values found are within the requested gap of the ends; if not, nothing tighter is proven."""
    is_whole: bool
    """Whether it is proven that physics refuses nothing within the limits. If not, the range is that of what it accepts."""
    low: float | None
    """No value is less; ``null`` if nothing is proven."""
    low_attained: float
    """The least value found."""


class Linear(Facts[Any]):
    """An output to first order."""

    __slots__ = ()
    _parts = {"effects": Facts, "sd_if_halved": Facts, "shares": Facts}

    effects: Facts[float | None]
    """The change of the output where an input increases by its standard deviation; ``null`` if it has an infinite one."""
    mean: float
    """The output at the means."""
    sd: float | None
    """Its standard deviation; ``null`` if an input has an infinite one."""
    sd_if_halved: Facts[float | None]
    """The standard deviation that would be left if one input had half its own."""
    shares: Facts[float | None]
    """The share of each input in the variance. With correlations a share may be negative; ``null`` if nothing matters."""


class Density(Facts[Any]):
    """The share of the samples in bins of equal width."""

    __slots__ = ()

    edges: list[float | None]
    """Edges of the bins, one more than bins, between the quantiles of 0.1 % and 99.9 %."""
    shares: list[float | None]
    """The share of the samples in each."""


class MonteCarlo(Facts[Any]):
    """An output of samples, each figure with its standard error (``se``)."""

    __slots__ = ()
    _parts = {"density": Density, "quantiles": Facts, "quantiles_se": Facts}

    density: Density
    """The density."""
    mean: float | None
    """The mean."""
    mean_se: float | None
    """Its standard error."""
    quantiles: Facts[float | None]
    """Quantiles by their probabilities."""
    quantiles_se: Facts[float | None]
    """Their standard errors; ``null`` where less than one sample is expected beyond a quantile."""
    sd: float | None
    """The standard deviation."""
    sd_se: float | None
    """Its standard error."""
    skewness: float | None
    """The third central moment over the cube of the standard deviation; ``null`` for an output that is certain."""


class SecondOrder(Facts[Any]):
    """An output to second order."""

    __slots__ = ()

    mean: float | None
    """The mean."""
    sd: float | None
    """The standard deviation; ``null`` if there is none."""
    skewness: float | None
    """The third central moment over the cube of the standard deviation; ``null`` if there is none."""


class ShapleyEffect(Facts[Any]):
    """The Shapley effect of an input on an output: its part of the variance, in which what inputs share by correlation or interaction
    is divided evenly. The effects of an output add up to 1; ``null`` for an output that is certain."""

    __slots__ = ()

    effect: float | None
    """The effect."""
    se: float | None
    """Its standard error."""


class Share(Facts[Any]):
    """The share of an input in the variance of an output."""

    __slots__ = ()

    first: float | None
    """Alone: the part of the variance that would go if it were known."""
    first_se: float | None
    """Its standard error."""
    total: float | None
    """With all others: the part that would be left if all others were known."""
    total_at_most: float | None
    """What ``total`` is at most, from derivatives at samples; ``null`` for a distribution without such a limit."""
    total_se: float | None
    """Its standard error."""


class OutputUncertainty(Facts[Any]):
    """An output with what the methods say of it; those that were not asked for, or do not apply, are absent."""

    __slots__ = ()
    _parts = {"bounds": Bounds, "linear": Linear, "monte_carlo": MonteCarlo, "second_order": SecondOrder, "shapley": partial(Facts, part=ShapleyEffect), "sobol": partial(Facts, part=Share)}

    bounds: Bounds | None
    """The guaranteed range over all inputs within their limits."""
    linear: Linear | None
    """From first derivatives at the means of the inputs."""
    monte_carlo: MonteCarlo | None
    """From samples."""
    second_order: SecondOrder | None
    """From first and second derivatives at the means of the inputs."""
    shapley: Facts[ShapleyEffect] | None
    """The part of each input in the variance, from samples: Shapley effects."""
    sobol: Facts[Share] | None
    """The share of each input in the variance, from samples: indices of Sobol'."""
    value: float | None
    """Its value at the nominal inputs; ``null`` if physics refuses them."""


class Probability(Facts[Any]):
    """The probability of a statement."""

    __slots__ = ()

    se: float | None
    """Its standard error."""
    value: float | None
    """The probability."""


class RefusedSamples(Facts[Any]):
    """Samples that physics refuses."""

    __slots__ = ()
    _parts = {"reasons": Facts}

    count: int
    """Their number."""
    reasons: Facts[int]
    """How many have each code of a refusal; a sample may have several."""


class Uncertainty(Answer):
    """An answer in SI and radians: the facts of a verb, with title and notices."""

    __slots__ = ()
    _parts = {"inputs": partial(Facts, part=UncertainNumber), "messages": NoticeEntry, "of": partial(Facts, part=OutputUncertainty), "probabilities": partial(Facts, part=Probability), "refused": RefusedSamples}

    inputs: Facts[UncertainNumber]
    """The uncertain inputs."""
    messages: list[NoticeEntry]
    """The same with code, severity, path and figures."""
    notes: list[str]
    """Notes and warnings as sentences in SI; omitted if there are none."""
    of: Facts[OutputUncertainty]
    """Each output with what the methods say of it."""
    probabilities: Facts[Probability]
    """The probability of each statement, as it is written."""
    refused: RefusedSamples
    """The samples that physics refuses: all figures of samples are of the others."""
    samples: int
    """The samples drawn, refused ones included: those of ``monte-carlo`` and of probabilities, or without these the ones of ``sobol``
    and ``shapley``; 0 if no method draws any."""
    schema: int
    """The version of this document."""
    seed: int
    """The seed of the samples."""
    title: str
    """The title of the file; empty if it has none."""


class Miss(Facts[Any]):
    """What a computed rest pose misses a given one by."""

    __slots__ = ()

    heading: float
    """Computed less given heading, in rad."""
    position: list[float]
    """Computed less given place, along x and y, in m."""


class State(Facts[Any]):
    """A state of the motion."""

    __slots__ = ()

    heading: float
    """Heading in rad."""
    t: float
    """Time since separation, in s."""
    vx: float
    """Velocity along x, in m/s."""
    vy: float
    """Velocity along y, in m/s."""
    wheels: list[list[float]]
    """Places of the wheels in m: front left, front right, rear left, rear right."""
    x: float
    """Place of the center of mass along x, in m."""
    y: float
    """Place along y, in m."""
    yaw_rate: float
    """Yaw rate in rad/s."""


class RestPose(Facts[Any]):
    """A pose."""

    __slots__ = ()

    heading: float
    """Heading in rad, whole turns counted."""
    position: list[float]
    """Place of the center of mass along x and y, in m."""


class VehicleSlide(Facts[Any]):
    """The slide of a vehicle from separation to rest."""

    __slots__ = ()
    _parts = {"miss": Miss, "path": State, "points": PointFit, "rest": RestPose}

    distance: float
    """Length of the path of the center of mass, in m."""
    miss: Miss | None
    """Distance of the rest pose from the given one, where the case has it."""
    name: str
    """Its name."""
    path: list[State]
    """The motion, from separation to rest."""
    points: list[PointFit]
    """Points along the path that the case gives, beside the places of this path that are nearest to them."""
    rest: RestPose
    """Where it comes to rest."""
    separation_from: str
    """``solve`` if its motion at separation is computed from the impact, ``given`` if it is evidence of the case."""
    time: float
    """Time from separation to rest, in s."""
    vehicle: int
    """Its number, 1 or 2."""


class Slides(Answer):
    """An answer in SI and radians: the facts of a verb, with title and notices."""

    __slots__ = ()
    _parts = {"messages": NoticeEntry, "vehicles": VehicleSlide}

    messages: list[NoticeEntry]
    """The same with code, severity, path and figures."""
    notes: list[str]
    """Notes and warnings as sentences in SI; omitted if there are none."""
    schema: int
    """The version of this document."""
    title: str
    """The title of the file; empty if it has none."""
    vehicles: list[VehicleSlide]
    """Each vehicle that the case gives wheels and ground."""


class Covariance(Facts[Any]):
    """Covariance of d0 and d1, those of the line through all tests."""

    __slots__ = ()

    basis: str
    """Its source: ``standard deviations`` of the file, or ``residuals``."""
    correlation: float
    """Correlation of d0 and d1."""
    d0_d0: float
    """Variance of d0 in N."""
    d0_d1: float
    """Covariance of d0 and d1 in N/m."""
    d0_sd: float
    """Standard deviation of d0 in √N."""
    d1_d1: float
    """Variance of d1 in N/m²."""
    d1_sd: float
    """Standard deviation of d1 in √N/m."""


class LinePoint(Facts[Any]):
    """A point of a fitted line, that of a flat crush."""

    __slots__ = ()

    crush_intensity: float
    """E* of the fit in √N."""
    depth: float
    """Depth of the crush in m."""
    sd: float | None
    """Its standard deviation from the covariance, in √N; ``null`` without one."""


class Predicted(Facts[Any]):
    """Crush energy of a flat crush predicted by a fit."""

    __slots__ = ()

    crush_energy: float
    """Crush energy in J."""
    depth: float
    """Its depth in m."""
    sd: float | None
    """Its standard deviation from the covariance, in J; ``null`` without one."""
    width: float
    """Its width in m."""


class Residuals(Facts[Any]):
    """E* of a test compared with a fit."""

    __slots__ = ()

    difference: float
    """Observed minus fitted, in √N."""
    fitted: float
    """E* of the fit in √N."""
    observed: float
    """E* of the test in √N."""
    standardised: float | None
    """The difference in standard deviations; ``null`` where the file gives none."""


class Fit(Facts[Any]):
    """A stiffness fitted to all tests."""

    __slots__ = ()
    _parts = {"covariance": Covariance, "line": LinePoint, "prediction": Predicted, "residuals": Residuals}

    A: float
    """A = d0 d1 in N/m."""
    B: float
    """B = d1² in N/m²."""
    G: float
    """G = d0²/2 in N."""
    b1: float | None
    """Slope b1 of the barrier speed against the crush, in 1/s."""
    chi_square: float
    """Sum of the squares of the standardised residuals."""
    covariance: Covariance | None
    """Covariance of d0 and d1; ``null`` where neither the file nor the residuals give the scatter."""
    d0: float
    """d0 in √N."""
    d1: float
    """d1 in √N/m."""
    degrees_of_freedom: int
    """Number of tests minus the number of fitted coefficients."""
    findings: list[str]
    """Implausible properties of this stiffness."""
    line: list[LinePoint]
    """The fitted line at 23 depths, evenly from no crush to a tenth beyond the deepest mean crush."""
    model: str
    """Representation of the crush: ``mean depth`` or ``profile``."""
    prediction: Predicted | None
    """Crush energy of the depth and width under ``[fit]``."""
    residuals: list[Residuals]
    """E* of each test compared with the fit."""


class PooledNumber(Facts[Any]):
    """A number of a class of vehicles, in the unit of the number, by the random-effects model of Paule and Mandel (1982)."""

    __slots__ = ()

    between_sd: float
    """Standard deviation between the vehicles of the class."""
    further_sd: float
    """Standard deviation of a further vehicle of the class about the mean, which is itself uncertain: 95 % of such vehicles lie
    within 1.96 of it."""
    mean: float
    """Mean over the class."""
    mean_sd: float
    """Standard deviation of the mean: 95 % of classes have theirs within 1.96 of it, however few vehicles tell the spread."""


class OfVehicle(Facts[Any]):
    """The stiffness of one vehicle of a class."""

    __slots__ = ()

    d0: float
    """d0 in √N."""
    d0_sd: float
    """Its standard deviation in √N; 0 where the tests do not give it, or d0 is held."""
    d1: float
    """d1 in √N/m."""
    d1_sd: float
    """Its standard deviation in √N/m; 0 where the tests do not give it."""
    name: str
    """Its name."""


class Pooled(Facts[Any]):
    """The stiffness of a class: its mean over the vehicles, and how much they differ."""

    __slots__ = ()
    _parts = {"d0": PooledNumber, "d1": PooledNumber, "vehicles": OfVehicle}

    d0: PooledNumber
    """d0 of the class in √N."""
    d1: PooledNumber
    """d1 of the class in √N/m."""
    model: str
    """Representation of the crush: ``mean depth`` or ``profile``."""
    vehicles: list[OfVehicle]
    """The stiffness of each vehicle."""


class Forms(Facts[Any]):
    """A stiffness in its equivalent forms."""

    __slots__ = ()

    A: float
    """A = d0 d1 in N/m."""
    B: float
    """B = d1² in N/m²."""
    G: float
    """G = d0²/2 in N."""
    b1: float | None
    """Slope b1 of the barrier speed against the crush, in 1/s."""
    d0: float
    """d0 in √N."""
    d1: float
    """d1 in √N/m."""


class Test(Facts[Any]):
    """A barrier test."""

    __slots__ = ()
    _parts = {"on_mean_depth": Forms, "on_profile": Forms}

    crush_energy: float
    """Crush energy in J, including that of earlier tests of the same vehicle."""
    crush_intensity: float
    """E* = √(2 E_C/w) in √N."""
    equivalent_energy_speed: float
    """Speed at which the crush energy is the vehicle's kinetic energy, in m/s."""
    mean_depth: float
    """Mean depth of the crush in m."""
    on_mean_depth: Forms | None
    """Stiffness computed from the mean depth of this test alone and the assumed onset."""
    on_profile: Forms | None
    """Stiffness computed from its profile."""
    restitution: float
    """Coefficient of restitution."""
    speed: float
    """Speed of the test in m/s."""
    vehicle: str
    """The name of the vehicle."""


class StiffnessAnswer(Answer):
    """An answer in SI and radians: the facts of a verb, with title and notices."""

    __slots__ = ()
    _parts = {"fits": Fit, "fits_as_new_cars": Fit, "messages": NoticeEntry, "pooled": Pooled, "tests": Test}

    fits: list[Fit]
    """Fits on mean depths and on the profiles; empty for one test, unless the file holds b0."""
    fits_as_new_cars: list[Fit]
    """The same with each test as that of a new car, for vehicles whose tests cannot be repeated tests of one car; absent unless there
    are such vehicles."""
    has_deviations: bool
    """``true`` if the file gives standard deviations."""
    headlines: list[str]
    """Why the fits are no stiffness, or may not be one; empty if they are."""
    messages: list[NoticeEntry]
    """The same with code, severity, path and figures."""
    notes: list[str]
    """Notes and warnings as sentences in SI; omitted if there are none."""
    pooled: list[Pooled]
    """The stiffness of the class, if two or more vehicles have a stiffness of their own."""
    schema: int
    """The version of this document."""
    tests: list[Test]
    """The tests in the order of the file."""
    title: str
    """The title of the file; empty if it has none."""


class Uncertain(Facts[Any]):
    """A number with its uncertainty."""

    __slots__ = ()

    sd: float | None
    """Its standard deviation; ``null`` where the recording does not tell it."""
    value: float
    """The number, in SI."""


class Peak(Facts[Any]):
    """The extreme value of a trace."""

    __slots__ = ()

    time: float
    """Its time, in s."""
    value: float
    """The value, in SI."""


class Accelerated(Facts[Any]):
    """An acceleration, integrated."""

    __slots__ = ()
    _parts = {"delta_v": Uncertain, "impulse": Uncertain, "peak": Peak, "restitution": Uncertain}

    channel: str
    """The name of its column."""
    delta_v: Uncertain
    """Velocity change, in m/s."""
    impulse: Uncertain | None
    """Impulse, in N s; ``null`` without a mass."""
    peak: Peak
    """The greatest acceleration of the filtered channel."""
    restitution: Uncertain | None
    """Restitution of the center of mass along the normal; ``null`` without a speed."""


class Barrier(Facts[Any]):
    """The load cells of a barrier."""

    __slots__ = ()
    _parts = {"delta_v": Uncertain, "impulse_ratio": Uncertain, "normal_impulse": Uncertain, "peak_force": Peak, "restitution": Uncertain, "tangential_impulse": Uncertain}

    delta_v: Uncertain | None
    """Velocity change along the normal, in m/s; ``null`` without a mass."""
    impulse_ratio: Uncertain | None
    """Impulse ratio, tangential to normal; ``null`` unless both are recorded."""
    normal_impulse: Uncertain | None
    """Impulse along the normal, in N s; ``null`` without such channels."""
    peak_force: Peak | None
    """The greatest normal force of the filtered channels; ``null`` without such channels."""
    restitution: Uncertain | None
    """Restitution of the center of mass along the normal; ``null`` without a mass and a speed."""
    tangential_impulse: Uncertain | None
    """Impulse along the barrier, in N s; ``null`` without such channels."""


class Clipped(Facts[Any]):
    """A stretch in which a channel was driven beyond its range."""

    __slots__ = ()

    samples: int
    """The number of its samples."""
    to: float
    """The time of its last sample, in s."""
    value: float
    """The value at which it stays, in SI."""


class ChannelAnswer(Facts[Any]):
    """A channel as it was read."""

    __slots__ = ()
    _parts = {"clipped": Clipped}

    clipped: Clipped | None
    """Where it was driven beyond its range; ``null`` if it was not."""
    is_truncated: bool
    """``true`` if it ends before the event does."""
    name: str
    """The name of its column."""
    period: float | None
    """The time from one sample to the next, in s; ``null`` if it varies."""
    quantity: Literal["normal_force", "tangential_force", "acceleration", "distance", "delta_v_forward", "delta_v_left", "delta_v_right", "speed"]
    """What it records."""
    resolution: float | None
    """The least step between two values, in SI; ``null`` if all are equal."""
    samples: int
    """The number of its samples."""
    to: float
    """The time of its last sample, in s."""


class Film(Facts[Any]):
    """The distance of a point from the barrier, smoothed and differentiated."""

    __slots__ = ()
    _parts = {"closing_speed": Uncertain, "restitution": Uncertain}

    channel: str
    """The name of its column."""
    closing_speed: Uncertain
    """Closing speed of the point, in m/s."""
    restitution: Uncertain
    """Restitution of the point."""
    separation: float
    """The time at which the point has separated, in s."""


class Kinematics(Facts[Any]):
    """The restitution of a point from measured kinematics, in SI."""

    __slots__ = ()
    _parts = {"restitution": Uncertain}

    heading_at_separation: float
    """Heading at separation, in rad."""
    restitution: Uncertain
    """Restitution of the point along the normal of the barrier."""
    separation: list[float]
    """Velocity of the point at separation: along the normal, and along the barrier, in m/s."""


class ClippedSensor(Facts[Any]):
    """A stretch in which the acceleration was beyond what the sensor holds."""

    __slots__ = ()

    acceleration: float
    """The greatest acceleration of the record, in m/s²."""
    channel: str
    """The name of the column of the velocity change."""
    to: float
    """When it ends, in s."""


class AtTime(Facts[Any]):
    """A value with its uncertainty and its time."""

    __slots__ = ()

    sd: float | None
    """Its standard deviation; ``null`` where the recording does not tell it."""
    time: float
    """Its time, in s."""
    value: float
    """The number, in SI."""


class VelocityChange(Facts[Any]):
    """The greatest velocity change."""

    __slots__ = ()
    _parts = {"forward": Uncertain, "left": Uncertain, "magnitude": Uncertain, "pdof": Uncertain}

    forward: Uncertain
    """Its longitudinal component at that time, forward positive, in m/s."""
    left: Uncertain
    """Its lateral component at that time, to the left positive, in m/s."""
    magnitude: Uncertain
    """Its magnitude, in m/s."""
    pdof: Uncertain | None
    """Principal direction of force, clockwise from straight ahead, in rad; ``null`` without a velocity change."""
    time: float
    """Its time, in s."""


class PreCrash(Facts[Any]):
    """A row of the table of speeds before the impact."""

    __slots__ = ()

    speed: float
    """The speed, in m/s."""
    time: float
    """The time, in s; zero is the impact."""


class AtImpact(Facts[Any]):
    """The speed at the impact: the last one that was stored before it."""

    __slots__ = ()

    sd: float | None
    """Its standard deviation; ``null`` where the recording does not tell it."""
    time: float
    """When it was stored, in s."""
    value: float
    """The number, in SI."""


class Recorder(Facts[Any]):
    """What an event data recorder kept, in SI and radians."""

    __slots__ = ()
    _parts = {"clipped_sensors": ClippedSensor, "delta_v_forward": AtTime, "delta_v_left": AtTime, "maximum": VelocityChange, "pre_crash": PreCrash, "speed_at_impact": AtImpact}

    clipped_sensors: list[ClippedSensor]
    """Velocity changes at the rate of the greatest acceleration that the sensors hold, where the recording says how much that is."""
    delta_v_forward: AtTime | None
    """The longitudinal velocity change of greatest magnitude, forward positive; ``null`` if it is not recorded."""
    delta_v_left: AtTime | None
    """The lateral velocity change of greatest magnitude, to the left positive; ``null`` if it is not recorded."""
    is_lower_bound: bool
    """``true`` if a velocity change, or the sensor behind it, is clipped or truncated: the true one is greater."""
    maximum: VelocityChange | None
    """The greatest velocity change of both together; ``null`` unless both are recorded."""
    pre_crash: list[PreCrash]
    """Speeds before the impact."""
    speed_at_impact: AtImpact | None
    """The speed at the impact; ``null`` if no speed is recorded."""


class Trace(Facts[Any]):
    """A channel or a bank over time."""

    __slots__ = ()

    filter: int | None
    """The channel frequency class that it is filtered to; ``null`` if it is not."""
    name: str
    """Its name."""
    quantity: Literal["normal_force", "tangential_force", "acceleration", "distance", "delta_v_forward", "delta_v_left", "delta_v_right", "speed"]
    """What it records."""
    times: list[float]
    """Times, in s."""
    unfiltered: list[float] | None
    """Values before the filter, in SI; ``null`` if it is not filtered."""


class RecordAnswer(Facts[Any]):
    """What a recording tells, in SI."""

    __slots__ = ()
    _parts = {"accelerations": Accelerated, "barrier": Barrier, "channels": ChannelAnswer, "films": Film, "kinematics": Kinematics, "recorder": Recorder, "traces": Trace}

    accelerations: list[Accelerated]
    """Each acceleration."""
    barrier: Barrier | None
    """The load cells of the barrier; ``null`` without any."""
    channels: list[ChannelAnswer]
    """Its channels."""
    file: str
    """The name of the file."""
    films: list[Film]
    """Each film."""
    kinematics: Kinematics | None
    """The restitution of a point from measured kinematics; left out without them."""
    recorder: Recorder | None
    """The event data recorder; ``null`` without one."""
    traces: list[Trace]
    """The channels for drawing: force channels summed by bank, filtered, less their baseline."""


class Records(Answer):
    """An answer in SI and radians: the facts of a verb, with title and notices."""

    __slots__ = ()
    _parts = {"messages": NoticeEntry, "records": RecordAnswer}

    messages: list[NoticeEntry]
    """The same with code, severity, path and figures."""
    notes: list[str]
    """Notes and warnings as sentences in SI; omitted if there are none."""
    records: list[RecordAnswer]
    """Each recording, in the order of the call."""
    schema: int
    """The version of this document."""
    title: str
    """The title of the file; empty if it has none."""


class Definition(Facts[Any]):
    """A quantity of a formula."""

    __slots__ = ()

    symbol: str
    """Its symbol."""
    text: str
    """Its definition on one line."""
    value: float | None
    """Its value in SI in the case; ``null`` without a case, or if it is not a number."""


class FormulaInput(Facts[Any]):
    """An input in a formula."""

    __slots__ = ()

    meaning: str
    """Form in which its number is given, if not plainly: ``.of_critical`` or `` (friction)``."""
    name: str
    """Its dotted name."""
    symbol: str
    """Its symbol."""
    value: float | None
    """Its value in SI in the case."""


class Formula(Answer):
    """The answer of ``formula``."""

    __slots__ = ()
    _parts = {"definitions": Definition, "inputs": FormulaInput, "messages": NoticeEntry}

    definitions: list[Definition]
    """The quantity, then the intermediate quantities that it is expressed in."""
    inputs: list[FormulaInput]
    """The inputs in it."""
    latex: str
    """The formula for a document, as LaTeX."""
    messages: list[NoticeEntry]
    """The same with code, severity, path and figures."""
    notes: list[str]
    """Notes and warnings as sentences in SI; omitted if there are none."""
    output: str
    """The name of the output."""
    rust: str
    """The formula for a program, as a Rust function of ``f64``."""
    schema: int
    """The version of this document."""
    subject: str
    """The subject of the formula, as a sentence."""
    wrt: str | None
    """The name of the input of the derivative."""


class CheckFinding(Facts[Any]):
    """A finding of a checked record in JSON."""

    __slots__ = ()

    bound: float | None
    """The bound that the resolutions or the tolerance imply."""
    rule: str
    """The rule."""
    severity: str
    """``warn``, ``fail`` or ``undecidable``."""
    size: float | None
    """Amount by which the rule is violated; ``null`` if there is no finite size."""
    what: str
    """One sentence with the numbers."""


class CheckedRecord(Facts[Any]):
    """A checked record in JSON."""

    __slots__ = ()
    _parts = {"findings": CheckFinding}

    file: str
    """The name of its file."""
    findings: list[CheckFinding]
    """The findings."""
    id: str
    """The name of the record, or its line."""
    line: int
    """The number of its line."""
    not_checked: list[str]
    """The rules that could not be evaluated."""
    verdict: str
    """``pass``, ``warn``, ``fail`` or ``undecidable``."""


class Summary(Facts[Any]):
    """Number of records with each verdict."""

    __slots__ = ()

    fail: int
    """Number of records that break a rule."""
    records: int
    """Number of records."""
    undecidable: int
    """Number of records that could not be decided."""
    warn: int
    """Number of records that pass with warnings."""


class CheckReport(Answer):
    """The JSON document of ``check``, which is written record by record."""

    __slots__ = ()
    _parts = {"records": CheckedRecord, "summary": Summary}

    interrupted: bool | None
    """``true`` if the run was interrupted before the last record."""
    records: list[CheckedRecord]
    """The records of all files."""
    schema: int
    """The version of this document."""
    summary: Summary
    """Number of records with each verdict."""
