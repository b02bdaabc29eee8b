//! The kernel run on symbols, and the names of its intermediate quantities.

use super::{Formula, Glossary};
use crate::collision::Collision;
use crate::frame::{CrushPlane, Heading, Nt};
use crate::input::{Input, Side};
use crate::law::ImpulseRatio;
use crate::moment::Moment;
use crate::output::{Output, Outputs};
use crate::scalar::Field;
use crate::scalar::symbol::Symbol;
use crate::vehicle::Party;
use alloc::format;
use alloc::vec::Vec;

/// The formulas of all outputs of one kind of collision.
#[derive(Clone, Debug)]
pub struct Formulas {
    record: Outputs<Symbol>,
    /// In the order of `Output::ALL`.
    formulas: Vec<Formula>,
}

impl Formulas {
    /// Derives the formulas of collisions like this one: with the same barriers and law, and the impulse ratio and the moment given in the same way. Its
    /// numbers are not used, so a `Collision<()>` is accepted.
    ///
    /// The variables are the [symbols](Input::symbol) of the inputs.
    pub fn of<T: Clone>(collision: &Collision<T>) -> Formulas {
        let collision = symbolic(collision);
        let contact = collision.contact();
        let (impulse, moment) = collision.impulse(&contact);
        let impact = collision.impact_of(&contact, impulse, moment);
        let outputs = Outputs::of(&collision, &impact);

        let mut glossary = Glossary::of_variables(&Input::ALL.map(Input::symbol));
        for (body, i) in [(&contact.one, 1), (&contact.two, 2)] {
            pair(&mut glossary, &format!("r{i}"), &body.arm);
            pair(&mut glossary, &format!("v{i}"), &body.velocity);
        }
        pair(&mut glossary, "v_", &contact.approach);
        let compliance = &contact.compliance;
        for (name, value) in
            [("K_nn", compliance.nn()), ("K_nt", compliance.nt()), ("K_tt", compliance.tt()), ("det_K", compliance.determinant())]
        {
            glossary.give(name, value);
        }
        if !matches!(collision.moment, Moment::None) {
            let row = contact.moment_compliance();
            glossary.give("omega_r", &contact.relative_yaw_rate());
            glossary.give("K_nm", &row.force.n);
            glossary.give("K_tm", &row.force.t);
            glossary.give("K_mm", &row.moment);
            glossary.give("M", &impact.moment);
        }
        if !matches!(collision.impulse_ratio, ImpulseRatio::Critical) {
            let sticking = Collision { impulse_ratio: ImpulseRatio::Critical, ..collision.clone() }.impulse(&contact).0;
            pair(&mut glossary, "P_0", &impact.critical_impulse);
            glossary.give("mu0", &outputs.critical_impulse_ratio);
            pair(&mut glossary, "P_s", &sticking);
        }
        for output in CAUSES.into_iter().flatten() {
            glossary.give(output.symbol(), &outputs[output]);
        }
        for (response, i) in [(&impact.one, 1), (&impact.two, 2)] {
            glossary.give(&format!("dV{i}f"), &response.delta_v_in_vehicle.forward);
            glossary.give(&format!("dV{i}l"), &response.delta_v_in_vehicle.left);
        }
        for output in EFFECTS.into_iter().flatten() {
            glossary.give(output.symbol(), &outputs[output]);
        }
        let formulas = Output::ALL.into_iter().map(|output| glossary.formula(output.symbol(), &outputs[output])).collect();
        Formulas { record: outputs, formulas }
    }

    /// Returns the formula of an output.
    pub fn output(&self, output: Output) -> &Formula {
        &self.formulas[output.index()]
    }

    /// Returns the recorded operations of the kernel that compute an output.
    pub fn record(&self, output: Output) -> &Symbol {
        &self.record[output]
    }
}

/// Outputs from which others are computed, each after those that it depends on.
const CAUSES: [[Output; 4]; 3] = {
    use Output::*;
    use Side::{One, Two};
    [
        [NormalImpulse, TangentialImpulse, CriticalImpulseRatio, ImpulseRatio],
        [ImpulseX, ImpulseY, NormalSeparation, TangentialSeparation],
        [DeltaVX(One), DeltaVY(One), DeltaVX(Two), DeltaVY(Two)],
    ]
};

/// Outputs that are computed from those.
const EFFECTS: [[Output; 4]; 4] = {
    use Output::*;
    use Side::{One, Two};
    [
        [VelocityX(One), VelocityY(One), VelocityX(Two), VelocityY(Two)],
        [YawRate(One), YawRate(Two), EnergyBefore, EnergyAfter],
        [NormalWork, TangentialWork, MomentWork, Loss],
        [DeltaVMagnitude(One), DeltaVMagnitude(Two), PrincipalDirectionOfForce(One), PrincipalDirectionOfForce(Two)],
    ]
};

fn pair(glossary: &mut Glossary, name: &str, of: &Nt<Symbol>) {
    glossary.give(&format!("{name}n"), &of.n);
    glossary.give(&format!("{name}t"), &of.t);
}

/// Returns the collision with a variable for each input.
fn symbolic<T: Clone>(collision: &Collision<T>) -> Collision<Symbol> {
    let mut all_zero = collision.clone().map(|_| Symbol::int(0));
    all_zero.crush_plane = CrushPlane { cos: Symbol::int(1), sin: Symbol::int(0) };
    for party in [&mut all_zero.one, &mut all_zero.two] {
        if let Party::Vehicle(vehicle) = party {
            vehicle.heading = Heading { cos: Symbol::int(1), sin: Symbol::int(0) };
        }
    }
    all_zero.shifted(|input| Symbol::variable(input.symbol()))
}
