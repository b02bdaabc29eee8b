//! Checks of a reconstruction problem, before any search.

use super::given::{GrowingError, ReconstructionProblem, Uncertainty, Unknown};
use super::issue::{ReconstructionIssue, ReconstructionIssues};
use super::measurand::Measurand;
use super::variable::{Variable, party};
use super::weight;
use crate::input::{Input, Side};
use crate::issue::{InputIssue, InputIssueKind, IssueCollector, Place};

/// The greatest number, and the inverse of the least deviation, whose square and whose products with squares of others are finite.
const GREATEST: f64 = 1e50;

/// Checks a standard deviation or a resolution.
fn deviation(numbers: &mut IssueCollector<InputIssue>, at: Place, value: f64) {
    if numbers.positive(at, &value) {
        numbers.within(at, &value, GREATEST.recip(), Some(GREATEST));
    }
}

impl ReconstructionProblem {
    /// Returns `true` if the share of vehicle 1 in the crush energy is known or solved for.
    fn has_crush_share(&self) -> bool {
        self.crush_share.is_some() || self.unknowns.iter().any(|unknown| unknown.of == Variable::CrushShare)
    }

    /// Returns `true` if the unknowns make a quantity known: the collision has it, and the share in the crush energy or the skid speed, if it takes one.
    pub fn determines(&self, of: Measurand) -> bool {
        let has_skid = |side: Side| {
            self.skid_speeds[side as usize].is_some() || self.unknowns.iter().any(|unknown| unknown.of == Variable::SkidSpeed(side))
        };
        of.is_in(&self.collision) && (!of.needs_share(&self.collision) || self.has_crush_share()) && of.skid().is_none_or(has_skid)
    }

    /// Checks that the problem is well posed.
    ///
    /// # Errors
    ///
    /// Every issue of the problem, such as crossed bounds or more unknowns without limits than evidence.
    pub fn check(&self) -> Result<(), ReconstructionIssues> {
        let mut found = self.issues_of_parts();
        // An unknown between two limits takes none, but evidence has to say something.
        let is_limited = |unknown: &Unknown| unknown.min.is_some() && unknown.max.is_some();
        let evidence = self.all_evidence().len();
        let unknowns = self.unknowns.iter().filter(|unknown| evidence == 0 || !is_limited(unknown));
        let unknowns: Vec<Variable> = unknowns.map(|unknown| unknown.of).collect();
        if unknowns.len() > evidence {
            found.push(ReconstructionIssue::TooLittleEvidence { unknowns, evidence });
        }
        found.finish()
    }

    /// Returns every issue but that of too little evidence.
    pub(super) fn issues_of_parts(&self) -> IssueCollector<ReconstructionIssue> {
        let mut found = IssueCollector::new();
        unknowns(self, &mut found);
        evidence(self, &mut found);
        growing_errors(self, &mut found);
        correlations(self, &mut found);
        if self.unknowns.is_empty() {
            found.push(ReconstructionIssue::NothingUnknown);
        }
        found
    }
}

fn unknowns(question: &ReconstructionProblem, found: &mut IssueCollector<ReconstructionIssue>) {
    for (i, unknown) in question.unknowns.iter().enumerate() {
        let of = unknown.of;
        if question.unknowns[..i].iter().any(|other| other.of == of) {
            found.push(ReconstructionIssue::UnknownTwice(of));
        }
        if !of.is_in(&question.collision) || (question.is_by_momentum() && Measurand::Variable(of).is_of_contact()) {
            found.push(ReconstructionIssue::NotInCase(of));
        }
        if let Variable::Speed(side) = of
            && question.unknowns.iter().any(|other| is_component(other.of, side))
        {
            found.push(ReconstructionIssue::SpeedAndVelocity(side));
        }
        numbers(question, unknown, found);
    }
    if let Some(share) = question.crush_share
        && !(0.0..=1.0).contains(&share)
    {
        let kind = InputIssueKind::OutOfRange { value: share, least: 0.0, greatest: Some(1.0) };
        let issue = InputIssue { at: Place::plain(Variable::CrushShare.name()), kind };
        found.push(ReconstructionIssue::Unknown { of: Variable::CrushShare, issue });
    }
}

/// Returns `true` if a vehicle stands, whatever the unknowns are: its velocity has no direction.
fn stands_still(question: &ReconstructionProblem, side: Side) -> bool {
    let moves = |of: Variable| of == Variable::Speed(side) || of == Variable::SkidSpeed(side) || is_component(of, side);
    let is_at_rest = party(&question.collision, side).vehicle().is_some_and(|vehicle| vehicle.motion.velocity.length() == 0.0);
    is_at_rest && !question.unknowns.iter().any(|unknown| moves(unknown.of))
}

fn is_component(variable: Variable, of: Side) -> bool {
    matches!(variable, Variable::Input(Input::VelocityX(side) | Input::VelocityY(side)) if side == of)
}

fn numbers(question: &ReconstructionProblem, unknown: &Unknown, found: &mut IssueCollector<ReconstructionIssue>) {
    let of = unknown.of;
    let at = Place::of(of.name(), of.measure());
    let before = found.count();
    for (what, value) in [("start", Some(unknown.start)), ("min", unknown.min), ("max", unknown.max), ("standard deviation", unknown.prior)]
    {
        if let Some(value) = value.filter(|value| !value.is_finite()) {
            let issue = InputIssue { at: at.part(what), kind: InputIssueKind::NotFinite { value } };
            found.push(ReconstructionIssue::Unknown { of, issue });
        }
    }
    let mut issues = IssueCollector::<InputIssue>::new();
    if let Some(sd) = unknown.prior.filter(|sd| sd.is_finite()) {
        deviation(&mut issues, at.part("standard deviation"), sd);
    }
    let of_shape = unknown.shape.and_then(|shape| shape.check().err());
    for issue in issues.finish().err().into_iter().flatten().chain(of_shape.into_iter().flatten()) {
        found.push(ReconstructionIssue::Unknown { of, issue });
    }
    if unknown.shape.is_some() && unknown.prior.is_none() {
        found.push(ReconstructionIssue::ShapeWithoutPrior(of));
    }
    if found.count() > before {
        return;
    }
    let (least, most) = of.domain(&question.collision);
    for bound in [unknown.min, unknown.max].into_iter().flatten() {
        if !(least..=most).contains(&bound) {
            found.push(ReconstructionIssue::BoundOutside { of, bound, least, most });
        }
    }
    if let (Some(min), Some(max)) = (unknown.min, unknown.max)
        && min >= max
    {
        found.push(ReconstructionIssue::BoundsCrossed { of, min, max });
        return;
    }
    let (min, max) = (unknown.min.unwrap_or(least), unknown.max.unwrap_or(most));
    if !(min..=max).contains(&unknown.start) {
        found.push(ReconstructionIssue::StartOutside { of, start: unknown.start, min, max });
    }
}

fn evidence(question: &ReconstructionProblem, found: &mut IssueCollector<ReconstructionIssue>) {
    for (i, evidence) in question.evidence.iter().enumerate() {
        let of = evidence.of;
        if question.evidence[..i].iter().any(|other| other.of == of) {
            found.push(ReconstructionIssue::EvidenceTwice(of));
        }
        if !of.is_in(&question.collision) {
            found.push(ReconstructionIssue::NothingToMeasure(of));
        }
        if of.needs_share(&question.collision) && !question.has_crush_share() {
            found.push(ReconstructionIssue::ShareUnknown(of));
        }
        let lacks_skid = of.skid().is_some() && of.is_in(&question.collision) && !question.determines(of);
        let has_no_direction = matches!(of, Measurand::ApproachDirection(side) if stands_still(question, side));
        if lacks_skid || has_no_direction || (question.is_by_momentum() && of.is_of_contact()) {
            found.push(ReconstructionIssue::NothingToMeasure(of));
        }
        let mut numbers = IssueCollector::<InputIssue>::new();
        let at = Place::of(of.name(), of.measure());
        if !of.is_magnitude() || numbers.not_negative(at, &evidence.value) {
            numbers.within(at, &evidence.value, -GREATEST, Some(GREATEST));
        }
        match evidence.uncertainty {
            Uncertainty::StandardDeviation(sd) => deviation(&mut numbers, at.part("standard deviation"), sd),
            Uncertainty::Resolution(step) => deviation(&mut numbers, at.part("resolution"), step),
            Uncertainty::Exact => {}
        }
        for issue in numbers.finish().err().into_iter().flatten() {
            found.push(ReconstructionIssue::Evidence { of, issue });
        }
    }
}

fn growing_errors(question: &ReconstructionProblem, found: &mut IssueCollector<ReconstructionIssue>) {
    for &GrowingError { of, at_fit, at_given, slope, relative_sd, power } in &question.growing_error {
        if !question.evidence.iter().any(|evidence| evidence.of == of) {
            found.push(ReconstructionIssue::NothingToMeasure(of));
        }
        let mut numbers = IssueCollector::<InputIssue>::new();
        let at = Place::of(of.name(), of.measure());
        for (what, value) in
            [("error at the fit", at_fit), ("error at the value", at_given), ("slope of the error", slope), ("power of the cause", power)]
        {
            numbers.within(at.part(what), &value, -GREATEST, Some(GREATEST));
        }
        deviation(&mut numbers, at.part("standard deviation of the cause"), relative_sd);
        for issue in numbers.finish().err().into_iter().flatten() {
            found.push(ReconstructionIssue::Evidence { of, issue });
        }
    }
}

fn correlations(question: &ReconstructionProblem, found: &mut IssueCollector<ReconstructionIssue>) {
    let before = found.count();
    let evidence = question.all_evidence();
    let known = |of: Measurand| evidence.iter().any(|evidence| evidence.of == of);
    for correlation in &question.correlations {
        let (one, other) = (correlation.one, correlation.other);
        if one == other || !known(one) || !known(other) {
            found.push(ReconstructionIssue::CorrelationOfNothing(one, other));
        }
    }
    let has_prior = |of: Variable| question.unknowns.iter().any(|unknown| unknown.of == of && unknown.prior.is_some());
    for correlation in &question.prior_correlations {
        let (one, other) = (correlation.one, correlation.other);
        if one == other || !has_prior(one) || !has_prior(other) {
            found.push(ReconstructionIssue::CorrelationOfNothing(Measurand::Variable(one), Measurand::Variable(other)));
        }
    }
    let has_any = !question.correlations.is_empty() || !question.prior_correlations.is_empty();
    if found.count() == before && has_any {
        let eigenvalue = weight::least_eigenvalue(question);
        if eigenvalue.is_nan() || eigenvalue <= weight::SINGULAR {
            found.push(ReconstructionIssue::CorrelationsImpossible { eigenvalue });
        }
    }
}
