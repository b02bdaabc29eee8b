//! From many starts to every solution.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;

use super::closed_form::at_crush_energy;
use super::determined::{Direction, named, weakest};
use super::given::{Reconstruction, Search, Unknown};
use super::measurable::Measurable;
use super::problem::{Stop, Unsolved};
use super::residuals::Model;
use super::scene::Scene;
use super::solution::Solution;
use super::variable::{Variable, party, speed};
use super::verdict::{Answer, Verdict};
use crate::input::Side;
use crate::least_squares::{self, Minimum, NoMinimum, Residuals, Span, Stopped};
use crate::moment::Moment;
use crate::vehicle::{Motion, Party};

/// How near, in scales, two ends of a search are the same.
const SAME: f64 = 1e-5;

/// How much larger χ² may be for a solution to count beside the best: chance makes it so in one case of a thousand.
const NEARLY_AS_GOOD: f64 = 10.83;

/// How often a start is drawn again where the mechanics refuses it.
const DRAWS: usize = 200;

impl Reconstruction {
    /// Searches for every set of unknowns that the evidence is likeliest with.
    ///
    /// The same question gets the same answer, bit for bit.
    ///
    /// # Errors
    ///
    /// [`Unsolved`]: every problem with the question, or why the search came to no end.
    pub fn solve(&self, search: &Search) -> Result<Answer, Unsolved> {
        self.check()?;
        let model = Model::of(self);
        let spans: Vec<Span> = self.unknowns.iter().map(|unknown| span(self, unknown)).collect();
        let found = Found::by(&model, &spans, &starts(&model, &spans, search)?, search)?;
        found.answer(&model, &spans, search)
    }
}

fn span(question: &Reconstruction, unknown: &Unknown) -> Span {
    let (least, most) = unknown.of.domain(&question.collision);
    Span {
        min: unknown.min.unwrap_or(least),
        max: unknown.max.unwrap_or(most),
        scale: unknown.of.scale(&question.collision, unknown.start),
    }
}

/// Where the searches start: where the question says, and at points drawn at random. The mechanics refuses none of them.
fn starts(model: &Model<'_>, spans: &[Span], search: &Search) -> Result<Vec<Vec<f64>>, Unsolved> {
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
            // Where hardly anything is possible, what was found will do.
            None => break,
        }
    }
    match (starts.is_empty(), refused) {
        (true, Some(refusals)) => Err(Unsolved::NoStart { starts: 1 + DRAWS, refusals }),
        _ => Ok(starts),
    }
}

/// The speed that the crush energy alone tells, where nothing else moves: works grow with its square, so there is no other.
fn speed_alone(question: &Reconstruction) -> Option<f64> {
    let ([unknown], [evidence], []) = (&question.unknowns[..], &question.evidence[..], &question.correlations[..]) else { return None };
    let (Variable::Speed(side), Measurable::CrushEnergy, None) = (unknown.of, evidence.of, unknown.prior) else { return None };
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

/// A value of an unknown: anywhere between its bounds; where one is missing, as far from the start as such unknowns are apart; by its prior where it has one.
fn draw(question: &Reconstruction, i: usize, span: &Span, random: &mut ChaCha8Rng) -> f64 {
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

/// An angle, as the turn of it that is nearest to the start, as far as the bounds allow.
fn nearest_turn(x: f64, unknown: &Unknown, span: &Span) -> f64 {
    let turned = unknown.of.period().map_or(x, |period| x - period * ((x - unknown.start) / period).round());
    if (span.min..=span.max).contains(&turned) { turned } else { x }
}

/// Where the searches ended.
struct Found {
    /// Different least sums of squares with how many searches ended there, the least first.
    minima: Vec<(Minimum, usize)>,
    /// Where the best of those that did not converge stopped.
    nearest: Option<Stopped>,
    searches: usize,
}

impl Found {
    fn by(model: &Model<'_>, spans: &[Span], starts: &[Vec<f64>], search: &Search) -> Result<Self, Unsolved> {
        let mut found = Found { minima: Vec::new(), nearest: None, searches: 0 };
        for start in starts {
            found.search_from(start, model, spans, search);
        }
        if starts.len() > 1 {
            for twin in found.twins(model, spans) {
                found.search_from(&twin, model, spans, search);
            }
        }
        found.minima.sort_by(|one, other| one.0.sum_of_squares.total_cmp(&other.0.sum_of_squares));
        if found.minima.is_empty() { Err(found.not_converged(model)) } else { Ok(found) }
    }

    fn search_from(&mut self, start: &[f64], model: &Model<'_>, spans: &[Span], search: &Search) {
        self.searches += 1;
        let near = model.softened().and_then(|soft| least_squares::minimum(&soft, start, spans, search.iterations).ok());
        let start = near.as_ref().map_or(start, |near| &near.unknowns);
        match least_squares::minimum(model, start, spans, search.iterations) {
            Ok(minimum) => self.add(model, spans, minimum),
            Err(NoMinimum::Stopped(stopped)) => {
                if self.nearest.as_ref().is_none_or(|nearest| stopped.sum_of_squares < nearest.sum_of_squares) {
                    self.nearest = Some(stopped);
                }
            }
            Err(NoMinimum::NoStart) => (),
        }
    }

    /// Where a solution close to one that was found may lie: two that the evidence hardly tells apart lie along the direction that it notices least, too near to
    /// each other for starts from afar to end at both.
    fn twins(&self, model: &Model<'_>, spans: &[Span]) -> Vec<Vec<f64>> {
        /// The first minima of so many have their twins looked for.
        const MINIMA: usize = 4;
        /// How far off, in scales.
        const DISTANCES: [f64; 4] = [1e-3, -1e-3, 3e-2, -3e-2];
        let mut starts = Vec::new();
        for (minimum, _) in self.minima.iter().take(MINIMA) {
            let mut jacobian = model.jacobian(&minimum.unknowns);
            for (mut column, span) in jacobian.column_iter_mut().zip(spans) {
                column *= span.scale;
            }
            let Some(direction) = weakest(&jacobian) else { continue };
            for distance in DISTANCES {
                let step = |i: usize| minimum.unknowns[i] + distance * direction[i] * spans[i].scale;
                starts.push((0..spans.len()).map(|i| step(i).clamp(spans[i].min, spans[i].max)).collect());
            }
        }
        starts
    }

    fn add(&mut self, model: &Model<'_>, spans: &[Span], mut minimum: Minimum) {
        for ((x, span), unknown) in minimum.unknowns.iter_mut().zip(spans).zip(&model.question.unknowns) {
            *x = nearest_turn(*x, unknown, span);
        }
        let is_same = |other: &Minimum| {
            let far = |i: usize| {
                let between = minimum.unknowns[i] - other.unknowns[i];
                let of = model.question.unknowns[i].of;
                let turns = of.period().map_or(0.0, |period| period * (between / period).round());
                (between - turns).abs() > SAME * spans[i].scale
            };
            !(0..spans.len()).any(far)
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

    fn not_converged(&self, model: &Model<'_>) -> Unsolved {
        let best = self.minima.first().map(|(minimum, _)| Stopped {
            unknowns: minimum.unknowns.clone(),
            sum_of_squares: minimum.sum_of_squares,
            step: 0.0,
            iterations: minimum.iterations,
            toward: Vec::new(),
        });
        let nowhere = Stopped { unknowns: Vec::new(), sum_of_squares: f64::NAN, step: f64::NAN, iterations: 0, toward: Vec::new() };
        let stopped = self.nearest.clone().or(best).unwrap_or(nowhere);
        let name = |(unknown, value): (&Unknown, &f64)| (unknown.of, *value);
        Unsolved::NotConverged {
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

    fn answer(self, model: &Model<'_>, spans: &[Span], search: &Search) -> Result<Answer, Unsolved> {
        let converged = self.converged();
        let solution = |(minimum, searches): &(Minimum, usize)| Solution::of(model, minimum, spans, *searches).ok();
        let best_minimum = &self.minima[0];
        let Some(best) = solution(best_minimum) else { return Err(self.not_converged(model)) };
        let is_nearer = |stopped: &Stopped| stopped.sum_of_squares < best.chi_square;
        if !best.is_explained() && self.nearest.as_ref().is_some_and(is_nearer) {
            return Err(self.not_converged(model));
        }
        let not_determined = directions(model, &best_minimum.0, spans);
        let mut answer = Answer {
            verdict: Verdict::Agrees,
            solutions: Vec::new(),
            worse: Vec::new(),
            not_determined,
            without_bounds: None,
            searches: self.searches,
            converged,
        };
        // Along a valley floor every search ends elsewhere.
        if answer.not_determined.is_empty() {
            let limit = best.chi_square + NEARLY_AS_GOOD;
            let others = self.minima[1..].iter().filter_map(solution);
            (answer.solutions, answer.worse) = others.partition(|other: &Solution| other.chi_square <= limit && other.is_explained());
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

fn directions(model: &Model<'_>, minimum: &Minimum, spans: &[Span]) -> Vec<Direction> {
    let variables: Vec<Variable> = model.question.unknowns.iter().map(|unknown| unknown.of).collect();
    let scales: Vec<f64> = spans.iter().map(|span| span.scale).collect();
    Solution::blind(model, minimum, spans).iter().map(|direction| named(direction, &variables, &scales)).collect()
}

/// The solution without the given bounds, where one of them holds an unknown and the evidence agrees beyond it.
fn without_bounds(question: &Reconstruction, best: &Solution, search: &Search) -> Option<Solution> {
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
    let question = Reconstruction { unknowns: question.unknowns.iter().map(free).collect(), ..question.clone() };
    let answer = question.solve(search).ok()?;
    let solution = answer.solutions.into_iter().next()?;
    (solution.is_explained() && answer.verdict != Verdict::Undetermined).then_some(solution)
}
