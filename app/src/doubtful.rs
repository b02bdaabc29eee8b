//! Warnings about the result of an impact that is possible, and deserves a second look.

use planar_impact::check::{self, Severity};
use planar_impact::{Collision, Impact};

use crate::message::Message;
use crate::notice::Notice;
use crate::units::Measure;

/// Share of its parts below which K_nn + μ K_nt takes more than five digits of the impulse.
pub(crate) const NEARLY_WEDGED: f64 = 1e-5;

/// Of a restitution that can gain energy, of a pair that nearly wedges, and of lacking digits; where sizes are usual and nothing else is found, an answer has all of them.
pub(crate) fn result(collision: &Collision, impact: &Impact, is_unusual: bool) -> Vec<Notice> {
    let mut found: Vec<Notice> = self::impact(collision, impact).collect();
    if is_unusual || !found.is_empty() {
        found.extend(few_digits(collision, impact));
    }
    found
}

/// Of a restitution that can gain energy, and of a pair that nearly wedges.
fn impact(collision: &Collision, impact: &Impact) -> impl Iterator<Item = Notice> {
    let can_gain = collision.admissible().filter(|admissible| collision.restitution > admissible.restitution_for_any_approach);
    let can_gain = can_gain.map(|admissible| {
        let message = Message::from("the restitution is above ")
            .figure(Measure::Ratio, admissible.restitution_for_any_approach)
            .text(", beyond which some approach velocities gain energy in this contact");
        Notice::warning("restitution-can-gain-energy", "contact.restitution", message)
    });
    let share = collision.contact().compliance.wedging_share(impact.impulse_ratio()).abs();
    let wedges = (share < NEARLY_WEDGED).then(|| {
        let digits = (15.0 + libm::log10(share)).floor().max(0.0);
        let message =
            format!("the pair nearly wedges: K_nn + mu K_nt is {share:.1e} of its parts, so the impulse has about {digits} digits");
        Notice::warning("nearly-wedged", "contact", message)
    });
    [can_gain, wedges].into_iter().flatten()
}

/// Of a tangential impulse that returns energy.
pub(crate) fn tangential_work(work: f64, loss: f64) -> Option<Notice> {
    /// Share of the loss above which W_t is no rounding.
    const RETURNED: f64 = 1e-9;
    let is_returned = work > 0.0 && work > RETURNED * loss;
    is_returned.then(|| Notice::warning("tangential-work-positive", "contact", "the tangential impulse returns energy: W_t is positive"))
}

/// Of a crush energy above the kinetic energy before the impact.
pub(crate) fn crush(crush: f64, before: f64) -> Option<Notice> {
    let message = || {
        Message::from("the crush takes ")
            .figure(Measure::Energy, crush)
            .text(", and before the impact there is a kinetic energy of ")
            .figure(Measure::Energy, before)
            .text(" in all: check the units of depths, width and stiffness, or the speeds")
    };
    (crush > before).then(|| Notice::warning("crush-beyond-energy", "vehicle", message()))
}

/// Of an answer that a check with all the digits of a float refuses.
fn few_digits(collision: &Collision, impact: &Impact) -> Option<Notice> {
    let outcome = check::check_exact(&check::Record::of(collision, impact), &check::Options::default());
    let worst = outcome.findings.iter().find(|finding| finding.severity == Severity::Fail)?;
    let message = format!("rounding takes digits that a check of this answer needs: {}", worst.what);
    Some(Notice::warning("few-digits", "contact", message))
}
