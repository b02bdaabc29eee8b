//! Help texts printed below the options of each verb.

pub(super) const STATUS: &str = "\
Exit status:
   0  done
   1  done, and something does not hold: a record breaks a law, a row or a case is
      refused, a reconstruction has no unique answer, a recording is incomplete, or
      tests contradict each other
   2  the input or the call is wrong, or a file cannot be read
   3  the physics refuses the input, or a search does not converge
  70  a defect of the program
  74  the output cannot be written
 130  interrupted";

pub(super) const CASE: &str = r#"A case file, TOML or JSON:
  schema = 1
  [[vehicle]]                        # exactly two
  name = "sedan"
  mass = "1163 kg"
  yaw_inertia = "1945 kg m^2"        # or radius_of_gyration = "1.3 m"
  heading = "180 deg"                # from x, counter-clockwise
  speed = "12 m/s"                   # or velocity = ["-12 m/s", "0 m/s"]
  yaw_rate = "0 deg/s"               # may be left out
  impact_center = ["1.9 m", "0 m"]   # from the center of mass: forward, left
  [[vehicle]]
  name = "wall"
  barrier = true                     # a fixed barrier has nothing else
  [contact]
  crush_plane = "0 deg"              # from x to the normal
  restitution = 0.15
  impulse_ratio = "critical"         # or 0.4, or { of_critical = 0.9 }
  # friction = 0.45                  # instead of impulse_ratio
  tangential_law = "brach"           # or "kudlich-slibar"
Quantities are strings with a unit, or bare numbers in SI.

Examples:
  planar-impact solve cli/examples/position-a.toml
  planar-impact solve cli/examples/sideswipe.toml --units us --format json"#;

pub(super) const SWEEP: &str = "\
The last value is among the points when it is a whole number of steps away. Values are written as
in a case file; the table and the chart show them in the unit of the first one. A case at the
critical ratio takes a given one when contact.impulse_ratio, contact.friction or
contact.impulse_ratio.of_critical is varied; likewise a moment. A point that the physics refuses
is empty, with the reason. Names are those of `planar-impact gradient --help`.

The paper's Table 2 and its Figure 4:
  planar-impact sweep cli/examples/position-a.toml --vary \"contact.crush_plane=-10deg:10deg:1deg\"
  planar-impact sweep cli/examples/position-a.toml --vary Gamma=-10deg:10deg:1deg --format svg

More examples:
  planar-impact sweep cli/examples/position-a.toml --vary mu=0:0.6:0.1 --of W_t,dV1 --format csv
  planar-impact sweep case.toml --vary e=0:0.3:0.02 --vary \"v1=30 mph:40 mph:1 mph\" --format svg";

pub(super) const COMPARE: &str = "\
2 to 20 cases, such as the same collision with another restitution, crush plane, law or set of
evidence. A case with [unknown] is reconstructed, any other is solved. Inputs and evidence that
are the same in all cases are left out. Speeds are in the unit of the road.

A case that the physics refuses is shown with its refusal, and the exit status is 1; likewise if a
reconstruction is no unique answer. It is 2 if a file cannot be read or is wrong.

Examples:
  planar-impact compare cli/examples/position-a.toml cli/examples/position-c.toml
  planar-impact compare cli/examples/position-a.toml case.toml --units si --format json
  planar-impact compare cli/examples/position-a.toml case.toml --format svg > compare.svg";

pub(super) const UNCERTAINTY: &str = "\
Any input of a vehicle, of its crush and of the contact may be uncertain: \"40 mph ± 2 mph\",
\"40 mph ± 5 %\", { value, sd }, { min, max }, { min, mode, max }, { value, sd, min, max },
{ median, factor }, { value, resolution }, { mean, sd, n } of n measurements, { values } or
{ file, column } that were measured. correlation = [[NAME, NAME, COEFFICIENT]] ties them. Samples
that the physics refuses are counted by reason, and never moved. Shares (sobol) are left out if
inputs are correlated, which have Shapley effects (shapley) instead; both if more than 1 % of the
samples are refused. Names are those of `planar-impact gradient --help`.

Examples:
  planar-impact uncertainty cli/examples/uncertain.toml
  planar-impact uncertainty cli/examples/uncertain.toml --of dV1 --probability \"dV1 > 18 mph\"
  planar-impact uncertainty cli/examples/uncertain.toml --of dV1,T_L --format svg > uncertainty.svg
  planar-impact uncertainty cli/examples/uncertain.toml --of dV1 --method linear,shapley
  planar-impact uncertainty cli/examples/uncertain.toml --precision 0.1% --points sobol";

pub(super) const SLIDE: &str = r#"The ground and the wheels are those of [rest]; `position` and `heading` at rest may be left out. A
vehicle separates with the motion of the solved impact, or with the one that [evidence] gives:
separation_velocity and separation_yaw_rate. Places are on the scene if the file says where the
vehicles met, and else counted from where each separated:
  [scene]
  impact_point = ["12.3 m", "4.1 m"]

Examples:
  planar-impact slide cli/examples/slide.toml
  planar-impact slide cli/examples/slide.toml --format csv > path.csv"#;

pub(super) const DRAW: &str = "\
The collision is that of `solve`, or that of `reconstruct` where the case has unknowns. A vehicle
that gives `length` and `width` has that outline, placed by `front_overhang` and the axles of
[rest]; without them it is a dashed symbol. Arrows start at the center of mass; impulses at the
impact center. Skids of [before] and rest positions of [rest] are drawn below.

Examples:
  planar-impact draw cli/examples/position-a.toml -o scene.svg
  planar-impact draw cli/examples/slide.toml --format json";

pub(super) const REPORT: &str = "\
One file that reads in any browser, without a script and without anything from elsewhere, and
prints on A4 with page numbers. It has the case file inside, in the element with the id `case`.
Sections: summary, scene, question, method, results, sensitivity, alternatives, validation, input,
glossary.

Examples:
  planar-impact report cli/examples/position-a.toml -o report.html
  planar-impact report cli/examples/reconstruct/momentum.toml --date \"3 May 2026\" > report.html
  planar-impact report cli/examples/cavalier-crush.toml --verb crush --sections summary,input
  planar-impact report cli/examples/tests/malibu.toml --verb stiffness -o fit.html
  planar-impact report cli/examples/check/collision.json --verb check
  planar-impact report --verb validate > validation.html";

pub(super) const GRADIENT: &str = "\
Names are those of the case file and of the JSON of `solve`, vehicles counted from 1, or symbols:
  inputs    vehicle.1.mass (m1), .yaw_inertia (I1), .radius_of_gyration (k1), .heading (theta1),
            .speed (v1), .velocity.x, .velocity.y, .yaw_rate (omega1), .impact_center.forward,
            .impact_center.left, .crush.width, .crush.depths.3, .crush.d0, .crush.d1;
            contact.crush_plane (Gamma), .restitution (e), .impulse_ratio (mu), .friction,
            .impulse_ratio.of_critical, .moment, .moment.of_critical
  outputs   energy.normal_work (W_n), .tangential_work (W_t), .loss (T_L), .before, .after;
            contact.critical_impulse_ratio (mu0), .impulse_ratio (mu), .impulse.normal (P_n), ...;
            vehicle.1.delta_v_magnitude (dV1), .velocity.x, .yaw_rate (Omega1), .pdof, ...;
            vehicle.1.crash3.delta_v_magnitude, .corrected_energy, .effective_mass_factor, ...
  all       every one
A derivative with respect to one input keeps the other keys of the file as they are given. At the
critical impulse ratio it is that of the critical solution, so the ratio changes with the inputs.

Examples:
  planar-impact gradient cli/examples/position-a.toml
  planar-impact gradient cli/examples/oblique-surfaces.toml --of dV1,dV2 --wrt Gamma,e
  planar-impact gradient cli/examples/position-a.toml --of W_n --second --format json";

pub(super) const BATCH: &str = r#"Columns by name, with their unit in brackets, or in the metadata of an Arrow field; SI without one:
  vehicle.1.mass [lb]   .yaw_inertia or .radius_of_gyration, .heading, .speed or .velocity.x and
                        .velocity.y, .yaw_rate, .impact_center.forward, .impact_center.left,
                        .crush.depths.3 ... of a case with crush; .barrier (true or false)
  contact.crush_plane   .restitution, .tangential_law, .moment, .moment.of_critical; one of
                        .impulse_ratio (a number or `critical`) and its .of_critical, .friction
Other columns pass through. What no column has, and an empty cell, is taken from --case, or is the
default of a case file. The output has the columns of the table, each output in SI (with `result.`
before its name where an input has it too), `d OUTPUT / d INPUT` for --wrt, and `refusal`: empty,
or why the row has no outputs, such as `separating`, or `unreadable` for a cell that is not a
number.

The exit status is 0 if every row is solved, and 1 if some are refused; with --fail-fast it is 3
or, for a row that cannot be read, 2. A file appears when it is whole.

Examples:
  planar-impact batch cli/examples/batch/speeds.csv --case cli/examples/position-a.toml -o -
  planar-impact batch cli/examples/batch/speeds.csv --case case.toml -o out.csv --of dV1 --wrt e"#;

pub(super) const VALIDATE: &str = "Examples:
  planar-impact validate
  planar-impact validate --format json
  planar-impact validate --figure 6 > figure-6.svg
  planar-impact validate --figure 7 > figure-7.svg";

pub(super) const CHECK: &str = r#"A file of records, in any of three forms:
  a JSON document   { "schema": "planar-impact-record/1", "units": { ... }, "records": [ ... ] }
  JSON Lines        the same without `records` on the first line, then a record on each line
  CSV               column names such as b1.after.vx, a line of units, then a record on each line
{
  "schema": "planar-impact-record/1",
  "units": { "length": "m", "mass": "kg", "time": "s", "angle": "deg" },
  "records": [ {
    "id": "case-1", "profile": "impulse",
    "bodies": [
      { "mass": 1163, "yaw_inertia": 1945, "cg": [0, 0],
        "before": { "v": [-17.88, 2], "yaw_rate": 0 },
        "after": { "v": [1.678, -0.709], "yaw_rate": -20.95 } },
      { "fixed": true } ],
    "contact": { "point": [-1.94, 0.3], "normal_angle": 0 },
    "model": { "restitution": 0.1, "impulse_ratio": -0.1385, "ratio_kind": "critical" },
    "reported": { "energy_loss": 186168, "work_normal": -183017, "delta_v": [19.745, null] },
    "resolution": { "v": 0.0005, "yaw_rate": 0.005, "energy": 0.5, "impulse_ratio": 0.00005 } } ]
}
Leave out unknown values; rules that need them are not checked. The documentation has the details:
planar_impact::guide::checking.

Examples:
  planar-impact check cli/examples/check/collision.json
  planar-impact check cli/examples/check/engine.jsonl cli/examples/check/template.csv --format json
  planar-impact check --rules"#;

pub(super) const CRUSH: &str = r#"Under a [[vehicle]] of the case file:
  [vehicle.crush]
  width = "1.6 m"                    # or stations = ["0 m", "0.4 m", "1.6 m"]
  depths = ["0.1 m", "0.3 m", "0 m"] # two or more; equally spaced over a width
  stiffness = { d0 = "90 N^0.5", d1 = "1000 N^0.5/m" }
  #         = { A = "90 kN/m", B = "1 MPa" }
  #         = { b0 = "2 m/s", b1 = "30 1/s", test_mass = "1500 kg", test_width = "1.6 m" }
  #         = { ..., saturation = "0.5 m" }: the force grows no more beyond that depth
  #         = [ { to = "0.4 m", d0 = ..., d1 = ... }, { d0 = ..., d1 = ... } ]: zones
  measured = { offset = "0.2 m", angle = "10 deg" }   # read from a line outside the surface
  surface = "front"                  # for crash3: right, rear, left; else from the crush plane
  pdof = "-10 deg"                   # for crash3: else that of the common-velocity impulse
Between two stations the depth is linear. `gradient` and `sweep` accept these numbers by names
such as vehicle.1.crush.depths.2 and vehicle.1.crush.zones.1.d0.

Examples:
  planar-impact crush cli/examples/cavalier-crush.toml
  planar-impact crush cli/examples/stiff-corner.toml --units si --format json"#;

pub(super) const RECORD: &str = r#"A recording is a CSV file. Its first line names the columns, each with its unit in brackets:
  time [ms]                          # zero at the impact, or the contact
  normal_force.NAME [kN]             # load cells, away from the barrier; they add up
  tangential_force.NAME [kN]         # along it, a quarter turn to the left of the normal force
  acceleration.NAME [g]              # of the center of mass, away from the barrier
  distance.NAME [mm]                 # of a point from the barrier, from film
  delta_v_forward [km/h]             # of an event data recorder, and delta_v_left or delta_v_right
  speed [km/h]                       # before the impact, at times up to zero
A cell is empty where a channel has no sample. A TOML or JSON file can say more:
  schema = 1
  file = "test.csv"                  # beside it; or samples = "the text of such a file"
  mass = "1500 kg"                   # for delta-V; may have a standard deviation
  speed = "10 m/s ± 0.05 m/s"        # normal to the barrier, for the restitution
  filter = 60                        # class of SAE J211 of peaks and traces; false for none
  baseline = ["-20 ms", "0 ms"]      # the unloaded channels: offset and noise
  window = ["0 ms", "110 ms"]        # the contact
  separation = "115 ms"              # of the point of a film
  resolution = "1 km/h"              # of a recorder, and relative = 0.05 for its other errors
  accelerometer_range = "50 g"       # what the sensors of a recorder hold
  [[channel]]                        # without any, columns are known by their names
  column = "F3"
  quantity = "normal_force"          # the names above
  calibration = "50 N"               # what one in the column is, if its header has no unit
  polarity = -1                      # if its sign is reversed
  range = "400 kN"                   # what it can hold
  [kinematics]                       # restitution of a point by its motion; needs no samples
  before = { velocity = ["10 m/s", "0 m/s"] }
  after = { velocity = ["-0.5 m/s ± 0.2 m/s", "0.3 m/s"], yaw_rate = "1 rad/s" }
  duration = "100 ms"
  point = ["1.9 m", "0 m"]           # forward, left; and point_after, on the deformed vehicle
Integrals are of the raw channels. Exit status 1: a channel is clipped, or ends before the event.

Evidence of `reconstruct`, and the restitution of a test of `stiffness`:
  [evidence]
  vehicle.2.recorder = { file = "edr.csv", use = ["delta_v_forward", "speed"] }
  contact.record = { file = "test.toml" }                 # impulse ratio and restitution
  [[vehicle.test]]
  restitution = { record = "test.toml" }

Examples:
  planar-impact record cli/examples/record/edr.csv
  planar-impact record cli/examples/record/barrier.toml --format json
  planar-impact record cli/examples/record/barrier.toml --format svg > traces.svg"#;

pub(super) const STIFFNESS: &str = r#"A file of barrier tests, TOML or JSON:
  schema = 1
  [[vehicle]]
  name = "sedan"
  new_cars = true                    # each test was of a new car; else they were of one car
  [[vehicle.test]]                   # one or more; those of one car in order: energies add up
  mass = "1500 kg"
  speed = "15.6 m/s"                 # normal to the barrier
  restitution = 0.1                  # or { record = "test.toml" }, or rebound_speed
  width = "1.5 m"                    # or stations
  depths = ["0.3 m", "0.5 m"]        # total crush after the test
  speed_sd = "0.1 m/s"               # standard deviations, each optional
  restitution_sd = 0.03
  scatter = "10 N^0.5"               # of E* from causes other than speed or restitution
  [fit]                              # optional
  b0 = "2 m/s"                       # speed that leaves no crush, held: fits d1 alone; or
  A = "50 kN/m"                      # force at which crush begins, held; or
  onset = "2 m/s"                    # assumed, for the stiffness from each first test alone
  depth = "0.4 m"                    # of a profile, for the uncertainty of its E_C
  width = "1.5 m"
Without standard deviations all tests have equal weight, and the scatter is that of the residuals.
A negative d0 or d1, and tests that cannot be of one car, are said first, with exit status 1.
Vehicles that have a stiffness each are pooled to a class: mean, and spread between vehicles.
Beside crush measured on another car, a line has the uncertainty of its fit, and not what one
car scatters about it: give the crush energy a relative standard deviation for that.
The energy of a test is 1/2 m (1 - e^2) v^2: the normal through the impact center has to meet
the center of mass. With an offset, part of the energy goes into yaw.

Examples:
  planar-impact stiffness cli/examples/tests/struble-welsh.toml
  planar-impact stiffness cli/examples/tests/malibu.toml --format json"#;

pub(super) const CRASH3: &str = "\
The energy of each vehicle's crush times 1 + tan^2 alpha, at most 2, alpha from the perpendicular
of the crushed surface to the principal force; the effective mass from the moment arm of the force
through the impact center; delta-V at common velocity; then approach velocities from the
separation velocities, those of planar mechanics unless the file has others:
  [evidence]
  vehicle.1.separation_velocity = [\"-3 m/s\", \"4 m/s\"]    # x, y
`crush --help` has the keys of the crush; `gradient` accepts the results by names such as
vehicle.1.crash3.delta_v_magnitude.

Examples:
  planar-impact crash3 cli/examples/cavalier-crush.toml
  planar-impact crash3 cli/examples/stiff-corner.toml --format json";

pub(super) const FORMULA: &str = r#"Without a case file the formula is that of two vehicles at the critical impulse
ratio under the law of Brach; --ratio, --law, --barrier and --moment change that.
With one it is the formula of the case, and text has the value of every line, in SI.

Examples:
  planar-impact formula W_n
  planar-impact formula W_n --wrt Gamma
  planar-impact formula T_L --ratio friction --barrier 2
  planar-impact formula mu0 --wrt contact.restitution --case cli/examples/position-a.toml
  planar-impact formula dV1 --format latex
  planar-impact formula energy.loss --wrt vehicle.1.mass --format rust > loss_by_mass.rs
  planar-impact formula --list"#;

pub(super) const RECONSTRUCT: &str = r#"A case file with unknowns, and the evidence for them:
  [evidence]                         # "12 m/s ± 1 m/s" (or +/-), { value = ..., sd = ... }
                                     # or { value = ..., resolution = ... }; a bare value is exact
  crush_energy = "from crush"        # or a value, or { value = "from crush", relative = 0.1 }
  vehicle.1.separation_velocity = ["-3 m/s ± 0.5 m/s", "4 m/s ± 0.5 m/s"]
  vehicle.1.separation_yaw_rate = "80 deg/s ± 10 deg/s"
  vehicle.2.speed = "30 mph ± 1 mph"
  vehicle.2.delta_v_magnitude = { value = "24 km/h", resolution = "1 km/h" }
  vehicle.2.recorder = { file = "edr.csv" }    # velocity change and speed: `record --help`
  [unknown]                          # start, bounds and prior sd, each optional
  vehicle.1.speed = { start = "30 mph", min = "0 mph" }
  contact.restitution = { start = 0.1, min = 0, max = 0.3 }
  contact.crush_plane = { start = "22 deg", sd = "5 deg" }
Evidence of a vehicle: separation_velocity, separation_speed, separation_direction,
separation_yaw_rate, delta_v (on the ground), delta_v_magnitude, delta_v_forward, delta_v_left,
pdof, crush_energy, equivalent_energy_speed, approach_direction, and every input. A key of
[[vehicle]] or [contact] that is unknown may be left out. An input in the evidence with an
uncertainty is solved for too. Rest positions are evidence of the separation: [rest], as in
cli/examples/reconstruct/two-cars.toml.

Each unknown has an interval by profile likelihood, at 95 % or --level; the bound or the limit of
the physics that makes an end is named. --profile adds where chi-square has risen by 1 and by 9.
--guaranteed adds the range outside of which nothing meets the evidence, proven with intervals:
exact evidence exactly, readings within half a step, the rest within --bounds-sd standard
deviations. --posterior adds the posterior: every value within the bounds of an unknown as likely
as another unless its density is given, times the likelihood of the evidence.

Exit status: 0 if the evidence agrees with one solution and narrows every unknown down; 1 if there
are several, an underdetermined unknown, inconsistent evidence or a best fit outside the bounds,
each with its numbers; 2 if the input is wrong, such as more unknowns than evidence; 3 if no
search converges.

Examples:
  planar-impact reconstruct cli/examples/reconstruct/position-a.toml
  planar-impact reconstruct cli/examples/reconstruct/two-cars.toml
  planar-impact reconstruct cli/examples/reconstruct/recorder.toml --brief
  planar-impact reconstruct cli/examples/reconstruct/two-cars.toml --probability "v1 > 50 km/h"
  planar-impact reconstruct cli/examples/reconstruct/crabbed-2.toml --format json --seed 7"#;
