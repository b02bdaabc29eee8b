//! Guaranteed ranges: whatever meets the evidence is within them, and their ends are those of closed forms.

use std::cell::Cell;

use planar_impact::reconstruct::*;
use planar_impact::*;
use proptest::prelude::*;

use super::scene::straight_into_barrier;

const SPEED: Variable = Variable::Speed(Side::One);
const RESTITUTION: Variable = Variable::Input(Input::Restitution);
const PLANE: Variable = Variable::Input(Input::CrushPlane);

fn ranges(problem: &ReconstructionProblem) -> Vec<GuaranteedRange> {
    problem.guaranteed(&GuaranteedSearch::default(), &|_| true).expect("it has ranges")
}

fn assert_near(range: &GuaranteedRange, low: f64, high: f64) {
    let room = 1e-6 * low.abs().max(high.abs()).max(1.0);
    assert!(range.is_tight, "{range:?}");
    for (bound, attained, end, sign) in [(range.low, range.low_attained, low, 1.0), (range.high, range.high_attained, high, -1.0)] {
        assert!(sign * (end - bound) >= -1e-12 * end.abs() && sign * (end - bound) <= room, "{end}: {range:?}");
        assert!(sign * (attained - end) >= -1e-9 * end.abs().max(1.0) && sign * (attained - end) <= room, "{end}: {range:?}");
    }
}

/// A straight collision with a barrier takes ½ m v² (1 − e²), here of a car of 1500 kg and e from 0 to 0.3.
fn by_energy(energy: f64, uncertainty: Uncertainty) -> ReconstructionProblem {
    ReconstructionProblem::of(straight_into_barrier(0.0)).unknown(SPEED, 10.0).between(RESTITUTION, 0.1, 0.0, 0.3).evidence(
        Measurand::CrushEnergy,
        energy,
        uncertainty,
    )
}

fn mass() -> f64 {
    straight_into_barrier(0.0).one.vehicle().expect("a car").mass
}

#[test]
fn ends_are_those_of_the_closed_form() {
    let speed = |energy: f64, e: f64| (2.0 * energy / mass() / (1.0 - e * e)).sqrt();
    for (uncertainty, error) in [(Uncertainty::Exact, 0.0), (Uncertainty::Resolution(4e3), 2e3), (Uncertainty::StandardDeviation(1e3), 3e3)]
    {
        let found = ranges(&by_energy(60e3, uncertainty));
        assert_eq!(found.iter().map(|range| range.of).collect::<Vec<_>>(), [SPEED, RESTITUTION]);
        assert_near(&found[0], speed(60e3 - error, 0.0), speed(60e3 + error, 0.3));
        assert_near(&found[1], 0.0, 0.3);
        // Where the ends are attained.
        assert!((found[0].at_low[1]).abs() < 1e-3 && (found[0].at_high[1] - 0.3).abs() < 1e-3, "{found:?}");
        assert_eq!((found[0].at_low[0], found[0].at_high[0]), (found[0].low_attained, found[0].high_attained));
    }
    let two = GuaranteedSearch { deviations: 2.0, ..GuaranteedSearch::default() };
    let found = by_energy(60e3, Uncertainty::StandardDeviation(1e3)).guaranteed(&two, &|_| true).expect("ranges");
    assert_near(&found[0], speed(58e3, 0.0), speed(62e3, 0.3));
}

#[test]
fn bounds_and_priors_limit_what_is_sought() {
    let narrow = |min: f64, max: f64| {
        let mut problem = by_energy(60e3, Uncertainty::Exact);
        (problem.unknowns[0].min, problem.unknowns[0].max) = (Some(min), Some(max));
        problem
    };
    let speed = |e: f64| (2.0 * 60e3 / mass() / (1.0 - e * e)).sqrt();
    let middle = 0.5 * (speed(0.0) + speed(0.3));
    let found = ranges(&narrow(middle, 40.0));
    assert_near(&found[0], middle, speed(0.3));
    // The restitution with which the energy takes that speed.
    assert_near(&found[1], (1.0 - (speed(0.0) / middle).powi(2)).sqrt(), 0.3);
    // A prior of 0.1 ± 0.02 is from 0.04 to 0.16.
    let prior = ReconstructionProblem::of(straight_into_barrier(0.0)).unknown(SPEED, 10.0).prior(RESTITUTION, 0.1, 0.02).evidence(
        Measurand::CrushEnergy,
        60e3,
        Uncertainty::Exact,
    );
    assert_near(&ranges(&prior)[0], speed(0.04), speed(0.16));
    // Without either a restitution is from 0 to 1, and no speed needs more than all of it.
    let free = ReconstructionProblem::of(straight_into_barrier(0.0)).between(SPEED, 12.5, 12.0, 13.0).unknown(RESTITUTION, 0.1).evidence(
        Measurand::CrushEnergy,
        60e3,
        Uncertainty::Exact,
    );
    let restitution = |speed: f64| (1.0 - 2.0 * 60e3 / mass() / (speed * speed)).sqrt();
    assert_near(&ranges(&free)[1], restitution(12.0), restitution(13.0));
}

#[test]
fn a_direction_is_not_its_opposite() {
    // A car that is hit from behind by a faster one, and drifted 0.1 rad to the left, at no more than 10 m/s either way.
    let slow = Vehicle::new(1500.0, 2500.0).with_impact_center(-2.0, 0.0);
    let fast = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.0).with_speed(40.0);
    let collision = Collision::new(slow, fast).with_crush_plane(CrushPlane::from_angle(std::f64::consts::PI));
    assert!(collision.solve().is_ok());
    let [x, y] = [Input::VelocityX(Side::One), Input::VelocityY(Side::One)].map(Variable::Input);
    let drift = |direction: f64| {
        ReconstructionProblem::of(collision).between(x, 1.0, -10.0, 10.0).between(y, 0.0, -10.0, 10.0).evidence(
            Measurand::ApproachDirection(Side::One),
            direction,
            Uncertainty::Exact,
        )
    };
    let found = ranges(&drift(0.1));
    assert_near(&found[0], 0.0, 10.0);
    assert_near(&found[1], 0.0, 10.0 * 0.1_f64.tan());
    assert_near(&ranges(&drift(0.1 - std::f64::consts::PI))[0], -10.0, 0.0);
    // A heading, a whole turn away.
    let heading = Variable::Input(Input::Heading(Side::Two));
    let turned = ReconstructionProblem::of(collision).between(heading, 0.0, -3.1, 3.1).evidence(
        Measurand::Variable(heading),
        0.2 + std::f64::consts::TAU,
        Uncertainty::Exact,
    );
    assert_near(&ranges(&turned)[0], 0.2, 0.2);
}

#[test]
fn momentum_alone_has_ranges_in_closed_form() {
    // One drives along x and the other along y, so that v₁ = V₁ₓ + (m₂/m₁) V₂ₓ and v₂ = V₂ᵧ + (m₁/m₂) V₁ᵧ.
    let [east, north] = [0.0, std::f64::consts::FRAC_PI_2].map(Heading::from_angle);
    let collision = Collision::new(Vehicle::new(1900.0, 1.0).with_heading(east), Vehicle::new(1700.0, 1.0).with_heading(north));
    let after = [
        (Output::VelocityX(Side::One), 6.0),
        (Output::VelocityY(Side::One), 7.0),
        (Output::VelocityX(Side::Two), 5.5),
        (Output::VelocityY(Side::Two), 8.0),
    ];
    let problem = ReconstructionProblem::of(collision).unknown(SPEED, 13.0).unknown(Variable::Speed(Side::Two), 16.0).by_momentum();
    let problem = after
        .into_iter()
        .fold(problem, |problem, (of, value)| problem.evidence(Measurand::Output(of), value, Uncertainty::StandardDeviation(0.1)));
    let found = ranges(&problem);
    for (range, (own, other, masses)) in found.iter().zip([(6.0, 5.5, 1700.0 / 1900.0), (8.0, 7.0, 1900.0 / 1700.0)]) {
        assert_near(range, own - 0.3 + masses * (other - 0.3), own + 0.3 + masses * (other + 0.3));
    }
}

#[test]
fn the_direction_of_a_force_is_not_that_of_its_opposite() {
    // A car that slides to the left or to the right into a post straight ahead: the force comes from the side that it slides to.
    let car = |speed: f64| Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.0).with_velocity(Xy { x: 10.0, y: speed });
    let base = |speed: f64| Collision::new(car(speed), Party::Barrier);
    let velocity = Variable::Input(Input::VelocityY(Side::One));
    for speed in [-3.0, 4.0] {
        let force = base(speed).solve().expect("a collision").one.force_direction().direction();
        let problem = ReconstructionProblem::of(base(0.0)).between(velocity, 0.0, -30.0, 30.0).evidence(
            Measurand::Output(Output::PrincipalDirectionOfForce(Side::One)),
            // A whole turn away is the same direction.
            force + std::f64::consts::TAU,
            Uncertainty::Exact,
        );
        assert_near(&ranges(&problem)[0], speed, speed);
    }
    // A mirrored angle leaves nothing for a car that does not reverse.
    let behind = ReconstructionProblem::of(base(0.0)).between(velocity, 0.0, -30.0, 30.0).evidence(
        Measurand::Output(Output::PrincipalDirectionOfForce(Side::One)),
        std::f64::consts::PI,
        Uncertainty::Exact,
    );
    assert_eq!(behind.guaranteed(&GuaranteedSearch::default(), &|_| true), Err(NoRange::Excluded));
}

#[test]
fn what_cannot_be_sought_is_named() {
    let search = GuaranteedSearch::default();
    let mass = Variable::Input(Input::Mass(Side::One));
    let open = by_energy(60e3, Uncertainty::Exact).unknown(mass, 1500.0);
    assert_eq!(open.guaranteed(&search, &|_| true), Err(NoRange::NoLimits(mass)));
    assert!(NoRange::NoLimits(mass).to_string().starts_with("vehicle.1.mass has no limits"));
    // A plane is looked at all around its start, whether it has no bounds or those of every direction.
    let all_around = |problem: ReconstructionProblem| ranges(&problem)[2].clone();
    let around = all_around(by_energy(60e3, Uncertainty::Exact).unknown(PLANE, 0.2));
    assert!(
        around.low >= 0.2 - std::f64::consts::FRAC_PI_2 - 1e-9 && around.high <= 0.2 + std::f64::consts::FRAC_PI_2 + 1e-9,
        "{around:?}"
    );
    assert!(around.low_attained < -0.5 && around.high_attained > 0.5 && around.assumed == [None, None], "{around:?}");
    assert_eq!(all_around(by_energy(60e3, Uncertainty::Exact).between(PLANE, 0.2, -4.0, 4.0)), around);
    // At most 200 m/s: 30 MJ.
    assert_eq!(by_energy(40e6, Uncertainty::Exact).guaranteed(&search, &|_| true), Err(NoRange::Excluded));
    // Without evidence everything between the limits meets it.
    assert_near(&ranges(&ReconstructionProblem::of(straight_into_barrier(0.0)).between(SPEED, 10.0, 5.0, 15.0))[0], 5.0, 15.0);
    let twice = by_energy(60e3, Uncertainty::Exact).unknown(SPEED, 10.0);
    assert!(matches!(twice.guaranteed(&search, &|_| true), Err(NoRange::Problem(_))));
}

#[test]
fn a_search_that_is_ended_has_ranges_that_still_hold() {
    let few = (1..40).map(|cells| (by_energy(60e3, Uncertainty::Exact), cells));
    let more = (20..260).step_by(20).map(|cells| (turned(), cells));
    for (problem, cells) in few.chain(more) {
        let whole = ranges(&problem);
        let search = GuaranteedSearch { cells, ..GuaranteedSearch::default() };
        match problem.guaranteed(&search, &|_| true) {
            Err(NoRange::NoPoint { cells: spent }) => assert!(spent <= cells),
            found => {
                let found = found.expect("ranges");
                for (range, whole) in found.iter().zip(&whole) {
                    assert!(range.cells <= cells && range.low <= whole.low_attained && whole.high_attained <= range.high, "{range:?}");
                    // A significant change of a speed is 1 m/s, and one of the others 0.1.
                    let size = if range.of == SPEED { range.high_attained } else { range.high_attained.max(0.1) };
                    let gap = (range.low_attained - range.low).max(range.high - range.high_attained);
                    assert_eq!(range.is_tight, gap <= 1e-6 * size, "{range:?}");
                }
                // What attains the end of one unknown attains values of the others.
                for point in found.iter().flat_map(|range| [&range.at_low, &range.at_high]) {
                    for (range, value) in found.iter().zip(point) {
                        assert!((range.low_attained..=range.high_attained).contains(value), "{value}: {range:?}");
                    }
                }
            }
        }
    }
    // It is asked now and then whether it goes on, with a count that grows over all unknowns.
    let last = Cell::new(0);
    let asked = |cells: usize| {
        assert!(cells == last.get() || cells >= last.get() + 60, "it is not asked for each cell: {cells} after {}", last.get());
        last.set(cells);
        cells < 100
    };
    let found = turned().guaranteed(&GuaranteedSearch { gap: 1e-12, ..GuaranteedSearch::default() }, &asked).expect("ranges");
    assert!(last.get() >= 100 && found.iter().any(|range| !range.is_tight));
}

/// A search that divides nothing attains what the search for solutions finds: here a crush plane to either side.
#[test]
fn solutions_are_attained_whatever_the_number_of_cells() {
    let into = straight_into_barrier;
    let energy = |plane: f64| -into(plane).solve().expect("a collision").work.n;
    for uncertainty in [Uncertainty::Exact, Uncertainty::StandardDeviation(10.0)] {
        let problem =
            ReconstructionProblem::of(into(0.1)).between(PLANE, 0.1, -0.8, 0.8).evidence(Measurand::CrushEnergy, energy(0.4), uncertainty);
        let planes =
            problem.solve(&Search::default()).expect("solutions").solutions.iter().map(|one| one.unknowns[0].value).collect::<Vec<_>>();
        assert!(planes.len() == 2 && planes.iter().all(|plane| (plane.abs() - 0.4).abs() < 1e-6), "{planes:?}");
        let found = problem.guaranteed(&GuaranteedSearch { cells: 1, ..GuaranteedSearch::default() }, &|_| true).expect("a range");
        let range = &found[0];
        assert!(range.low_attained <= -0.4 + 1e-9 && range.high_attained >= 0.4 - 1e-9, "{range:?}");
        assert!([range.low_attained, range.high_attained].iter().all(|plane| (energy(*plane) - energy(0.4)).abs() < 30.1), "{range:?}");
    }
}

/// A speed from the crush energy of two cars, with brackets of the restitution and of the crush plane.
fn turned() -> ReconstructionProblem {
    let [one, two] = cars(15.0, 8.0);
    let collision = Collision::new(one, two).with_restitution(0.1).with_crush_plane(CrushPlane::from_angle(0.2));
    let energy = -collision.solve().expect("a collision").work.n;
    bracketed(collision).unknown(SPEED, 12.0).evidence(Measurand::CrushEnergy, energy, Uncertainty::Exact)
}

fn cars(one: f64, two: f64) -> [Vehicle; 2] {
    let [ahead, across] =
        [Vehicle::new(1500.0, 2500.0).with_impact_center(1.8, 0.4), Vehicle::new(1300.0, 2100.0).with_impact_center(1.7, -0.3)];
    [ahead.with_speed(one), across.with_heading(Heading::from_angle(2.4)).with_speed(two)]
}

fn bracketed(collision: Collision) -> ReconstructionProblem {
    ReconstructionProblem::of(collision).between(RESTITUTION, 0.1, 0.0, 0.3).between(PLANE, 0.2, 0.0, 0.5)
}

#[test]
fn ends_are_those_of_a_dense_search() {
    let problem = turned();
    let found = &ranges(&problem)[2];
    assert!(found.is_tight);
    let target = problem.evidence[0].value;
    let (mut least, mut greatest) = (f64::INFINITY, f64::NEG_INFINITY);
    for e in (0..=30).map(|e| f64::from(e) * 0.01) {
        for plane in (0..=50).map(|plane| f64::from(plane) * 0.01) {
            // The energy grows with the speed from where the cars begin to approach: bisection.
            let energy = |speed: f64| {
                let [one, two] = cars(speed, 8.0);
                let collision = Collision::new(one, two).with_restitution(e).with_crush_plane(CrushPlane::from_angle(plane));
                collision.solve().map_or(0.0, |impact| -impact.work.n)
            };
            let (mut low, mut high) = (0.0, 60.0);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if energy(middle) < target { low = middle } else { high = middle }
            }
            (least, greatest) = (least.min(low), greatest.max(low));
        }
    }
    assert!(found.low <= least && greatest <= found.high, "{found:?}, and {least} to {greatest}");
    assert!(least - found.low < 1e-3 && found.high - greatest < 1e-3, "{found:?}, and {least} to {greatest}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn the_truth_is_within(
        speeds in [5.0..25.0, 2.0..20.0],
        e in 0.0..0.3,
        plane in 0.0..0.5,
        form in 0..3_usize,
        known in 0..5_usize,
    ) {
        let [one, two] = cars(speeds[0], speeds[1]);
        let ratio = [ImpulseRatio::Critical, ImpulseRatio::LimitedByFriction(0.3), ImpulseRatio::OfCritical(0.7)][form];
        let collision = Collision::new(one, two).with_restitution(e).with_crush_plane(CrushPlane::from_angle(plane)).with_impulse_ratio(ratio);
        let Ok(impact) = collision.solve() else { return Ok(()) };
        let both = |problem: ReconstructionProblem| problem.between(SPEED, 12.0, 0.0, 40.0).between(Variable::Speed(Side::Two), 12.0, 0.0, 40.0);
        let of = |problem: ReconstructionProblem, of: Measurand, value: f64| problem.evidence(of, value, Uncertainty::Exact);
        let (delta_v, after) = (&impact.one.delta_v, &impact.two.after.velocity);
        let problem = bracketed(collision);
        let problem = match known {
            0 => of(problem.between(SPEED, 12.0, 0.0, 40.0), Measurand::CrushEnergy, -impact.work.n),
            1 => of(problem.between(SPEED, 12.0, 0.0, 40.0), Measurand::Output(Output::DeltaVMagnitude(Side::One)), delta_v.length()),
            2 => {
                let speed = (2.0 * 0.4 * -impact.work.n / 1500.0).sqrt();
                let problem = ReconstructionProblem { crush_share: Some(0.4), ..problem };
                of(problem.between(SPEED, 12.0, 0.0, 40.0), Measurand::EquivalentEnergySpeed(Side::One), speed)
            }
            3 => of(
                of(both(problem), Measurand::SeparationSpeed(Side::Two), after.length()),
                Measurand::SeparationDirection(Side::Two),
                after.y.atan2(after.x),
            ),
            _ => of(
                of(both(problem), Measurand::DeltaVForward(Side::One), impact.one.delta_v_in_vehicle.forward),
                Measurand::ClosingSpeed,
                impact.approach.n.abs(),
            ),
        };
        let truth = [e, plane, speeds[0], speeds[1]];
        let search = GuaranteedSearch { gap: 1e-3, cells: 2_000, ..GuaranteedSearch::default() };
        match problem.guaranteed(&search, &|_| true) {
            Ok(found) => for (range, truth) in found.iter().zip(truth) {
                let rounding = 1e-12 * truth.abs().max(1.0);
                prop_assert!(range.low <= truth + rounding && truth - rounding <= range.high, "{truth}: {range:?}");
                prop_assert!(range.low <= range.low_attained && range.low_attained <= range.high_attained && range.high_attained <= range.high);
                // What is attained is a collision with this evidence.
                for at in [&range.at_low, &range.at_high] {
                    let [one, two] = cars(at[2], at.get(3).copied().unwrap_or(speeds[1]));
                    let there = Collision::new(one, two).with_restitution(at[0]).with_crush_plane(CrushPlane::from_angle(at[1])).with_impulse_ratio(ratio);
                    let met = there.solve().expect("physics accepts it");
                    let pairs = match known {
                        0 | 2 => vec![(met.work.n, impact.work.n)],
                        1 => vec![(met.one.delta_v.length(), delta_v.length())],
                        3 => vec![(met.two.after.velocity.x, after.x), (met.two.after.velocity.y, after.y)],
                        _ => vec![(met.one.delta_v_in_vehicle.forward, impact.one.delta_v_in_vehicle.forward), (met.approach.n.abs(), impact.approach.n.abs())],
                    };
                    for (met, given) in pairs {
                        prop_assert!((met - given).abs() <= 1e-9 * given.abs().max(1.0), "{met} is not {given}");
                    }
                }
            },
            Err(reason) => prop_assert!(matches!(reason, NoRange::NoPoint { .. }), "{reason}"),
        }
    }
}

/// A cell that is too small to divide leaves the others: a search that met one before any point gave up.
#[test]
fn a_range_is_found_beside_cells_too_small_to_divide() {
    let one = Vehicle::new(2165.0, 3890.0).with_impact_center(1.69, -0.25).with_speed(8.1);
    let two = Vehicle::new(1235.0, 1746.0)
        .with_heading(Heading::from_angle(std::f64::consts::PI))
        .with_impact_center(-0.09, -0.37)
        .with_speed(16.4);
    let (speed, yaw_rate) = (Variable::Speed(Side::Two), Variable::Input(Input::YawRate(Side::Two)));
    let of = |name| Measurand::named(name).expect("a measurand");
    let problem = ReconstructionProblem::of(Collision::new(one, two).with_restitution(0.5))
        .between(speed, 16.4, 15.6, 16.4)
        .between(yaw_rate, 0.0, -1.0, 0.25)
        .evidence(of("energy.loss"), 80e3, Uncertainty::StandardDeviation(46e3))
        .evidence(of("vehicle.1.separation_speed"), 3.3, Uncertainty::StandardDeviation(2.0))
        .evidence(of("vehicle.2.delta_v_magnitude"), 21.3, Uncertainty::StandardDeviation(0.3));
    // The best fit: its loss is off by 1.65, its speed by 0.4, its change of velocity by 0.2 standard deviations.
    let found = ranges(&problem);
    assert!(found[0].low <= 16.07 && 16.07 <= found[0].high && found[1].low <= -0.99, "{found:?}");
}
