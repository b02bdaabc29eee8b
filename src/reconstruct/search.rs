//! Multistart search for every solution.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;

use super::closed_form::at_crush_energy;
use super::determined::{Direction, named};
use super::given::{ReconstructionProblem, Search, Unknown};
use super::measurand::Measurand;
use super::piece::Piece;
use super::residuals::Model;
use super::scene::Scene;
use super::solution::{Seen, Solution};
use super::solve_error::{SolveError, Stop};
use super::standstill::best_at_standstill;
use super::variable::{Variable, party, speed, turns};
use super::verdict::{Answer, Verdict};
use super::within_limits::WithinLimits;
use crate::input::Side;
use crate::least_squares::limited::{self, Reached, Until};
use crate::least_squares::{self, FitError, Minimum, NotConverged, ParameterBounds, Residuals, by_chi_square};
use crate::moment::Moment;
use crate::refusal::Refusal;
use crate::vehicle::{Motion, Party};

/// Largest distance, in scales, of two results of a search that are the same.
const SAME: f64 = 1e-5;

/// Distance of twins, in scales: two solutions that are nearer to each other are not looked for.
const TWINS: f64 = 1e-3;

/// Largest difference of χ² along a flat valley, as a share of 1 + χ². Searches end anywhere in it.
const LEVEL: f64 = 1e-6;

/// Largest excess of χ² over the best at which a solution counts as an alternative: by chance it is exceeded in one case of a thousand.
const NEARLY_AS_GOOD: f64 = 10.83;

/// Largest difference of χ² between fits that are equally good.
pub(super) const INDISTINCT: f64 = 0.01;

/// Maximum number of draws of a start that the mechanics accepts.
const DRAWS: usize = 200;

impl ReconstructionProblem {
    /// Searches for every set of unknowns with maximum likelihood.
    ///
    /// The same problem has the same answer, bit for bit.
    ///
    /// # Errors
    ///
    /// [`SolveError`]: every issue of the problem, or the reason why the search did not converge.
    pub fn solve(&self, search: &Search) -> Result<Answer, SolveError> {
        self.solve_while(search, &|_, _| true)
    }

    /// As [`ReconstructionProblem::solve`], and calls a function before each start, with the number of starts that are done and of all. It stops the search by
    /// returning `false`.
    ///
    /// # Errors
    ///
    /// [`SolveError`].
    pub fn solve_while(&self, search: &Search, goes_on: &dyn Fn(usize, usize) -> bool) -> Result<Answer, SolveError> {
        self.check()?;
        let model = Model::of(self);
        let spans = spans(self);
        let found = Found::by(&model, &spans, &starts(&model, &spans, search)?, search, goes_on)?;
        found.answer(&model, &spans, search)
    }
}

/// Returns the range and the scale of each unknown.
pub(super) fn spans(question: &ReconstructionProblem) -> Vec<ParameterBounds> {
    let span = |unknown: &Unknown| {
        let (least, most) = unknown.of.domain(&question.collision);
        ParameterBounds {
            min: unknown.min.unwrap_or(least),
            max: unknown.max.unwrap_or(most),
            scale: unknown.of.scale(&question.collision, unknown.start),
        }
    };
    question.unknowns.iter().map(span).collect()
}

/// Returns the starts of the searches: the given one, and points drawn at random. The mechanics accepts each of them.
fn starts(model: &Model<'_>, spans: &[ParameterBounds], search: &Search) -> Result<Vec<Vec<f64>>, SolveError> {
    if let Some(speed) = speed_alone(model.question) {
        return Ok(vec![vec![speed.clamp(spans[0].min, spans[0].max)]]);
    }
    let given: Vec<f64> = model.question.unknowns.iter().map(|unknown| unknown.start).collect();
    let refused = model.solve(&given).err();
    let mut starts: Vec<Vec<f64>> = model.at(&given).map(|_| given).into_iter().collect();
    let mut random = ChaCha8Rng::seed_from_u64(search.seed);
    while starts.len() < search.starts.max(1) {
        let drawn = (0..DRAWS).find_map(|_| {
            let point: Vec<f64> = (0..spans.len()).map(|i| draw(model.question, i, &spans[i], &mut random)).collect();
            model.at(&point).map(|_| point)
        });
        match drawn {
            Some(point) => starts.push(point),
            // If hardly anything is possible, use the starts found so far.
            None => break,
        }
    }
    if starts.is_empty() {
        // A start that is not refused has residuals beyond the floats.
        let refusals = refused.unwrap_or_else(|| Refusal::OutOfFloatRange.into());
        return Err(SolveError::NoStart { starts: 1 + DRAWS, refusals });
    }
    Ok(starts)
}

/// Returns the speed that the crush energy alone determines if nothing else moves. The work grows with the square of the speed, so there is only one.
fn speed_alone(question: &ReconstructionProblem) -> Option<f64> {
    let ([unknown], [evidence], []) = (&question.unknowns[..], &question.evidence[..], &question.correlations[..]) else { return None };
    let (Variable::Speed(side), Measurand::CrushEnergy, None) = (unknown.of, evidence.of, unknown.prior) else { return None };
    let at_rest = |party: &Party| party.vehicle().is_none_or(|vehicle| vehicle.motion == Motion::rest());
    let other = match side {
        Side::One => &question.collision.two,
        Side::Two => &question.collision.one,
    };
    let mut placed = Scene::of(question).place(&[unknown.start]).collision;
    if !at_rest(other) || party(&placed, side).vehicle()?.motion.yaw_rate != 0.0 || question.collision.moment != Moment::None {
        return None;
    }
    placed.solve().ok()?;
    placed = at_crush_energy(&placed, evidence.value);
    placed.solve().ok()?;
    party(&placed, side).vehicle().map(speed)
}

/// Draws a value of an unknown: uniformly between its bounds; if one is missing, up to the spread of such unknowns from the start; from its prior if it has
/// one.
pub(super) fn draw(question: &ReconstructionProblem, i: usize, span: &ParameterBounds, random: &mut ChaCha8Rng) -> f64 {
    let unknown = &question.unknowns[i];
    if let Some(sd) = unknown.prior {
        let normal: f64 = random.sample(StandardNormal);
        return (unknown.start + 3.0 * sd * normal).clamp(span.min, span.max);
    }
    let spread = unknown.of.spread(&question.collision, unknown.start);
    let from = if span.min.is_finite() { span.min } else { unknown.start.min(span.max) - spread };
    let to = if span.max.is_finite() { span.max } else { unknown.start.max(span.min) + spread };
    from + (to - from) * random.random::<f64>()
}

/// Returns an angle in the turn nearest to the start, or in the one beside it, as far as the bounds allow.
fn nearest_turn(x: f64, unknown: &Unknown, span: &ParameterBounds) -> f64 {
    let Some(period) = unknown.of.period() else { return x };
    let turned = x - turns(x - unknown.start, Some(period));
    [turned, turned + period, turned - period].into_iter().find(|turned| (span.min..=span.max).contains(turned)).unwrap_or(x)
}

/// Results of the searches.
struct Found {
    /// Distinct minima with the number of searches that ended in each; the least sum of squares first.
    minima: Vec<(Minimum, usize)>,
    /// The best of the searches that did not converge.
    nearest: Option<NotConverged>,
    searches: usize,
}

impl Found {
    fn by(
        model: &Model<'_>,
        spans: &[ParameterBounds],
        starts: &[Vec<f64>],
        search: &Search,
        goes_on: &dyn Fn(usize, usize) -> bool,
    ) -> Result<Self, SolveError> {
        let mut found = Found { minima: Vec::new(), nearest: None, searches: 0 };
        let soft = model.softened();
        for (done, start) in starts.iter().enumerate() {
            if !goes_on(done, starts.len()) {
                return Err(SolveError::Stopped);
            }
            found.search_from(start, model, soft.as_ref(), spans, search);
        }
        if starts.len() > 1 {
            let near_and_far: Vec<Vec<f64>> = found.twins(model, spans).into_iter().chain(found.at_bounds(spans)).collect();
            for twin in near_and_far {
                found.search_from(&twin, model, soft.as_ref(), spans, search);
            }
        }
        found.minima.sort_by(|one, other| by_chi_square(one.0.sum_of_squares, other.0.sum_of_squares));
        if found.minima.is_empty() { Err(found.not_converged(model)) } else { Ok(found) }
    }

    /// Searches with the model, starting from the result of the softened model if there is one.
    fn search_from(&mut self, start: &[f64], model: &Model<'_>, soft: Option<&Model<'_>>, spans: &[ParameterBounds], search: &Search) {
        self.searches += 1;
        let near = soft.and_then(|soft| least_squares::minimum(soft, start, spans, search.iterations).ok());
        let start = near.as_ref().map_or(start, |near| &near.unknowns);
        let end = least_squares::minimum(model, start, spans, search.iterations);
        let reached = match &end {
            Ok(minimum) => &minimum.unknowns,
            Err(FitError::NotConverged(stopped)) => &stopped.unknowns,
            Err(FitError::NoStart) => return,
        };
        if let Some(minimum) = best_at_standstill(model, reached, spans, search.iterations) {
            return self.add(model, spans, minimum);
        }
        let is_possible = |unknowns: &[f64]| model.solve(unknowns).is_ok();
        let stopped = match end {
            Ok(minimum) if is_possible(&minimum.unknowns) => return self.add(model, spans, minimum),
            // A fit may run to where the vehicles no longer close, such as two speeds of zero.
            Ok(minimum) => stopped_at(&minimum),
            Err(FitError::NotConverged(stopped)) => stopped,
            Err(FitError::NoStart) => return,
        };
        let from = if is_possible(&stopped.unknowns) { &stopped.unknowns } else { start };
        if let Some(minimum) = at_the_edge(model, from, spans, search) {
            return self.add(model, spans, minimum);
        }
        if self.nearest.as_ref().is_none_or(|nearest| stopped.sum_of_squares < nearest.sum_of_squares) {
            self.nearest = Some(stopped);
        }
    }

    /// Returns starts at the minimum that was found first, but with one unknown at one of its bounds: chance seldom finds a solution there.
    fn at_bounds(&self, spans: &[ParameterBounds]) -> Vec<Vec<f64>> {
        let Some((found, _)) = self.minima.first() else { return Vec::new() };
        let ends = spans.iter().enumerate().flat_map(|(i, span)| [(i, span.min), (i, span.max)]).filter(|(_, bound)| bound.is_finite());
        let at = |(i, bound): (usize, f64)| {
            let mut start = found.unknowns.clone();
            start[i] = bound;
            start
        };
        ends.map(at).collect()
    }

    /// Returns starts near each minimum, in case of another solution close to it: two that the evidence barely distinguishes lie along the direction that it
    /// constrains least, and too close to each other for distant starts to find both.
    fn twins(&self, model: &Model<'_>, spans: &[ParameterBounds]) -> Vec<Vec<f64>> {
        /// Number of minima for which this is done.
        const MINIMA: usize = 4;
        /// Distances from the minimum, in scales.
        const DISTANCES: [f64; 4] = [TWINS, -TWINS, 3e-2, -3e-2];
        let mut starts = Vec::new();
        for (minimum, _) in self.minima.iter().take(MINIMA) {
            let jacobian = least_squares::scaled(model.jacobian(&minimum.unknowns), spans);
            let Some(direction) = least_squares::weakest(jacobian) else { continue };
            for distance in DISTANCES {
                let step = |i: usize| minimum.unknowns[i] + distance * direction[i] * spans[i].scale;
                starts.push((0..spans.len()).map(|i| step(i).clamp(spans[i].min, spans[i].max)).collect());
            }
        }
        starts
    }

    fn add(&mut self, model: &Model<'_>, spans: &[ParameterBounds], mut minimum: Minimum) {
        for ((x, span), unknown) in minimum.unknowns.iter_mut().zip(spans).zip(&model.question.unknowns) {
            *x = nearest_turn(*x, unknown, span);
        }
        let is_same = |other: &Minimum| {
            let distance = |i: usize| {
                let between = minimum.unknowns[i] - other.unknowns[i];
                let period = model.question.unknowns[i].of.period();
                (between - turns(between, period)).abs() / spans[i].scale
            };
            let same = if are_level(minimum.sum_of_squares, other.sum_of_squares) { TWINS } else { SAME };
            (0..spans.len()).all(|i| distance(i) <= same)
        };
        match self.minima.iter_mut().find(|(other, _)| is_same(other)) {
            Some((other, searches)) => {
                *searches += 1;
                if minimum.sum_of_squares < other.sum_of_squares {
                    *other = minimum;
                }
            }
            None => self.minima.push((minimum, 1)),
        }
    }

    fn converged(&self) -> usize {
        self.minima.iter().map(|(_, searches)| searches).sum()
    }

    fn not_converged(&self, model: &Model<'_>) -> SolveError {
        let best = self.minima.first().map(|(minimum, _)| stopped_at(minimum));
        let nowhere = NotConverged { unknowns: Vec::new(), sum_of_squares: f64::NAN, step: f64::NAN, iterations: 0, toward: Vec::new() };
        let stopped = self.nearest.clone().or(best).unwrap_or(nowhere);
        let name = |(unknown, value): (&Unknown, &f64)| (unknown.of, *value);
        SolveError::NotConverged {
            searches: self.searches,
            converged: self.converged(),
            nearest: Stop {
                unknowns: model.question.unknowns.iter().zip(&stopped.unknowns).map(name).collect(),
                chi_square: stopped.sum_of_squares,
                step: stopped.step,
                iterations: stopped.iterations,
                beyond: if stopped.toward.is_empty() { None } else { model.solve(&stopped.toward).err() },
            },
        }
    }

    fn answer(self, model: &Model<'_>, spans: &[ParameterBounds], search: &Search) -> Result<Answer, SolveError> {
        let converged = self.converged();
        let seen = |(minimum, searches): &(Minimum, usize)| Seen::of(model, minimum, spans, *searches);
        // No search may have come to a better fit than the answer, also where it could not end.
        let least = self.nearest.iter().map(|stopped| stopped.sum_of_squares).fold(self.minima[0].0.sum_of_squares, f64::min);
        let as_good = self.minima.iter().take_while(|(minimum, _)| minimum.sum_of_squares <= least + INDISTINCT);
        let found = as_good.enumerate().find_map(|(i, found)| Some((i, seen(found)?)));
        let Some((chosen, Seen { solution: best, open })) = found else { return Err(self.not_converged(model)) };
        let mut answer = Answer {
            verdict: Verdict::Agrees,
            solutions: Vec::new(),
            worse: Vec::new(),
            not_determined: directions(model, &open, spans),
            without_bounds: None,
            searches: self.searches,
            converged,
        };
        // In a flat valley every search ends in a different place.
        if answer.not_determined.is_empty() {
            let limit = best.chi_square + NEARLY_AS_GOOD;
            let others = one_of_each_valley(self.minima[chosen + 1..].iter().filter_map(seen)).map(|seen| seen.solution);
            let (as_good, worse): (Vec<_>, Vec<_>) = others.partition(|other: &Solution| other.chi_square <= limit && other.is_explained());
            // The interval of the best one goes on beyond the corner.
            let (beyond_corner, rivals): (Vec<_>, Vec<_>) =
                as_good.into_iter().partition(|other| is_one_beyond_corner(model, &best, other));
            answer.solutions = rivals;
            answer.worse = beyond_corner.into_iter().chain(worse).collect();
        }
        answer.verdict = if !best.is_explained() {
            answer.without_bounds = without_bounds(model.question, &best, search).map(Box::new);
            if answer.without_bounds.is_some() { Verdict::BoundsExclude } else { Verdict::Contradicted }
        } else if !answer.not_determined.is_empty() {
            Verdict::Undetermined
        } else if !answer.solutions.is_empty() {
            Verdict::SeveralSolutions
        } else {
            Verdict::Agrees
        };
        answer.solutions.insert(0, best);
        Ok(answer)
    }
}

/// Returns `true` if two sums of squares are those of one flat valley.
fn are_level(one: f64, other: f64) -> bool {
    (one - other).abs() <= LEVEL * (1.0 + other)
}

/// Returns `true` if two solutions lie on either side of where friction begins to hold, or where sliding changes its side, and the evidence agrees about as well with
/// all that is between them: a corner in one valley, and not two answers.
fn is_one_beyond_corner(model: &Model<'_>, one: &Solution, other: &Solution) -> bool {
    /// Points between them.
    const POINTS: i32 = 16;
    /// Largest rise of χ² on the way from one to the other: that of one standard deviation.
    const RISE: f64 = 1.0;
    let [from, to] = [one, other].map(|solution| solution.unknowns.iter().map(|estimate| estimate.value).collect::<Vec<f64>>());
    let piece = |unknowns: &[f64]| model.solve(unknowns).ok().map(|(placed, _)| Piece::of(&placed));
    // In a flat valley beyond the corner every search ends in a different place.
    if piece(&from) == piece(&to) || !other.unknowns.iter().all(|estimate| estimate.is_determined) {
        return false;
    }
    let limit = one.chi_square.max(other.chi_square) + RISE;
    (1..POINTS).all(|point| {
        let share = f64::from(point) / f64::from(POINTS);
        let between: Vec<f64> = from.iter().zip(&to).map(|(from, to)| from + share * (to - from)).collect();
        model.at(&between).is_some_and(|residuals| residuals.iter().map(|residual| residual * residual).sum::<f64>() <= limit)
    })
}

/// Leaves one of the minima that lie in the same flat valley, where every search ends in a different place.
fn one_of_each_valley(minima: impl Iterator<Item = Seen>) -> impl Iterator<Item = Seen> {
    let mut valleys: Vec<f64> = Vec::new();
    minima.filter(move |seen| {
        let chi_square = seen.solution.chi_square;
        let is_new = seen.open.is_empty() || !valleys.iter().any(|other| are_level(chi_square, *other));
        if is_new && !seen.open.is_empty() {
            valleys.push(chi_square);
        }
        is_new
    })
}

/// Describes a minimum that is no answer.
fn stopped_at(minimum: &Minimum) -> NotConverged {
    let Minimum { unknowns, sum_of_squares, iterations, .. } = minimum.clone();
    NotConverged { sum_of_squares, step: 0.0, iterations, toward: unknowns.clone(), unknowns }
}

/// Continues a search that stopped where the mechanics refuses its next step, along that edge, or where friction begins to hold: within the piece of the mechanics
/// that it stopped in, and in those beyond the edges that it meets.
fn at_the_edge(model: &Model<'_>, stopped: &[f64], spans: &[ParameterBounds], search: &Search) -> Option<Minimum> {
    let (placed, impact) = model.solve(stopped).ok()?;
    let mut problem = WithinLimits::around(model, stopped, &placed, &impact);
    let (mut pieces, mut best) = (vec![Piece::of(&placed)], None::<Reached>);
    let mut at = stopped.to_vec();
    let mut next = 0;
    while let Some(piece) = pieces.get(next) {
        problem.keep_to(*piece);
        let to = |until| limited::minimum(&problem, &at, spans, limited::LONG, search.iterations, until);
        // Where the vehicles hardly close, hardly anything depends on the unknowns.
        let flat = || to(Until::Sum).ok().filter(|reached| problem.hardly_closes(&reached.unknowns));
        if let Some(reached) = to(Until::Unknowns).ok().or_else(flat) {
            at.clone_from(&reached.unknowns);
            let beyond: Vec<Piece> = problem.beyond(&at).into_iter().filter(|piece| !pieces.contains(piece)).collect();
            pieces.extend(beyond);
            if best.as_ref().is_none_or(|best| reached.sum_of_squares < best.sum_of_squares) {
                best = Some(reached);
            }
        }
        next += 1;
    }
    let best = best?;
    model.solve(&best.unknowns).ok()?;
    // The least approach velocity is a share of that at the start, unless this is small.
    if problem.hardly_closes(&best.unknowns) && impact.approach.n.abs() > 1.0 {
        return at_the_edge(model, &best.unknowns, spans, search);
    }
    Some(best.into_minimum())
}

fn directions(model: &Model<'_>, open: &[Vec<f64>], spans: &[ParameterBounds]) -> Vec<Direction> {
    let variables: Vec<Variable> = model.question.unknowns.iter().map(|unknown| unknown.of).collect();
    let scales: Vec<f64> = spans.iter().map(|span| span.scale).collect();
    open.iter().map(|direction| named(direction, &variables, &scales)).collect()
}

/// Returns the solution without the given bounds, if one of them is active and the evidence agrees beyond it.
fn without_bounds(question: &ReconstructionProblem, best: &Solution, search: &Search) -> Option<Solution> {
    let is_given = |estimate: &super::Estimate| {
        let unknown = question.unknowns.iter().find(|unknown| unknown.of == estimate.of);
        unknown.is_some_and(|unknown| match estimate.at {
            Some(least_squares::Bound::Min) => unknown.min.is_some(),
            Some(least_squares::Bound::Max) => unknown.max.is_some(),
            None => false,
        })
    };
    if !best.unknowns.iter().any(is_given) {
        return None;
    }
    let free = |unknown: &Unknown| Unknown { min: None, max: None, ..*unknown };
    let question = ReconstructionProblem { unknowns: question.unknowns.iter().map(free).collect(), ..question.clone() };
    let answer = question.solve(search).ok()?;
    let solution = answer.solutions.into_iter().next()?;
    (solution.is_explained() && answer.verdict != Verdict::Undetermined).then_some(solution)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collision::Collision;
    use crate::reconstruct::variable::Axis;
    use crate::vehicle::Vehicle;

    #[test]
    fn starts_without_a_bound_lie_within_the_spread_on_either_side() {
        let collision = Collision::new(Vehicle::new(1500.0, 2500.0).with_speed(15.0), Vehicle::new(1000.0, 2000.0));
        let question = ReconstructionProblem::of(collision).unknown(Variable::Speed(Side::One), 15.0);
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let [low, high] = [f64::NEG_INFINITY, f64::INFINITY];
        // The spread of speeds is 20 m/s.
        for (min, max, from, to) in [(low, high, -5.0, 35.0), (low, 20.0, -5.0, 20.0), (14.0, high, 14.0, 35.0), (14.0, 15.5, 14.0, 15.5)] {
            let span = ParameterBounds { min, max, scale: 1.0 };
            let drawn: Vec<f64> = (0..1000).map(|_| draw(&question, 0, &span, &mut random)).collect();
            let [least, greatest] = [f64::min, f64::max].map(|of| drawn.iter().copied().reduce(of).expect("draws"));
            let margin = 0.02 * (to - from);
            assert!((from..from + margin).contains(&least) && (to - margin..=to).contains(&greatest), "{min} {max}: {least} {greatest}");
        }
        // The reduced mass is 600 kg.
        assert!((Variable::Impulse(Axis::X).spread(&collision, 0.0) - 12_000.0).abs() < 1e-9);
    }
}
