//! An output that is not one of the impact alone, as a function of the uncertain numbers of a case: of crush, of CRASH3, of braking.

use std::cell::Cell;
use std::fmt;

use planar_impact::crash3::Surface;
use planar_impact::scalar::interval::{Interval, Truth};
use planar_impact::uncertainty::{Bounded, RefusedPart};
use planar_impact::{ForceDirection, Ordered, Real, Side};

use super::super::model::{CaseModel, is_beside_impact};
use crate::case::{CaseOutput, Crash3Key, Crash3Outputs, Domain, Inputs, Parameter, Setup, VehicleInputs, vehicle_number};

/// An output of crush, of CRASH3 or of braking.
pub struct BesideImpact<'a> {
    model: &'a CaseModel,
    /// The inputs of the case, those that are uncertain at zero.
    certain: Inputs,
    of: CaseOutput,
    /// The surfaces that CRASH3 takes for crushed where the file does not say.
    surfaces: [Surface; 2],
    /// Whether it is proven that physics refuses no impact within the ranges.
    is_impact_possible: bool,
    /// Direction from which the angle of a force is measured.
    ahead: Option<ForceDirection>,
}

/// The surface of a vehicle that CRASH3 needs is not the same for all values of the uncertain numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceLeftOpen(Side);

impl fmt::Display for SurfaceLeftOpen {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = vehicle_number(self.0);
        write!(
            f,
            "within the limits of the inputs it is not certain which surface of vehicle {number} is crushed; give vehicle.{number}.crush.surface"
        )
    }
}

impl<'a> BesideImpact<'a> {
    /// Returns an output of a model as a function of its numbers within ranges.
    ///
    /// # Errors
    ///
    /// If CRASH3 needs a surface that the ranges leave open.
    pub fn of(model: &'a CaseModel, of: CaseOutput, ranges: &[(f64, f64)]) -> Result<Self, SurfaceLeftOpen> {
        let range = |(low, high): &(f64, f64)| Interval::new(*low, *high).unwrap_or(Interval::ENTIRE);
        let whole: Vec<Interval> = ranges.iter().map(range).collect();
        let of_impact: Vec<Interval> = of_impact(model, ranges).iter().map(range).collect();
        let mut function = BesideImpact {
            model,
            certain: model.with(&vec![0.0; ranges.len()]),
            of,
            surfaces: [Surface::Front; 2],
            is_impact_possible: model.impact().refused_part(&of_impact) == RefusedPart::None,
            ahead: None,
        };
        if matches!(of, CaseOutput::Crash3(..)) {
            function.surfaces = certain_surfaces(&function.setup(&whole))?;
        }
        Ok(function)
    }

    fn setup<T: Real + Copy + From<f64>>(&self, numbers: &[T]) -> Setup<T> {
        self.certain.setup(|parameter| self.model.place(parameter).map_or(T::int(0), |place| numbers[place]))
    }

    fn crash3<T: Real + Copy + From<f64>>(&self, setup: &Setup<T>, side: Side, key: Crash3Key) -> Option<T> {
        let energies = setup.energies(&Side::ALL.map(|side| setup.crush_of(side)))?;
        let pair = setup.damaged(energies, |side, _, _| self.surfaces[side as usize]);
        if let (Crash3Key::Pdof, Some(ahead)) = (key, &self.ahead) {
            let damaged = [pair.one, pair.two][side as usize]?;
            return Some(damaged.force_direction.direction_about(ahead));
        }
        Crash3Outputs::of_pair(pair)[side as usize].as_ref().map(|outputs| outputs.get(key))
    }
}

/// Returns ranges of which those of numbers that the impact does not depend on are held at their middle.
pub fn of_impact(model: &CaseModel, ranges: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let held = |(low, high): (f64, f64)| [0.5 * low + 0.5 * high; 2].into();
    let of = |(parameter, range): (&Parameter, &(f64, f64))| if is_beside_impact(*parameter) { held(*range) } else { *range };
    model.parameters().iter().zip(ranges).map(of).collect()
}

/// Returns the crushed surface of each vehicle, whatever the numbers in their intervals are.
fn certain_surfaces(setup: &Setup<Interval>) -> Result<[Surface; 2], SurfaceLeftOpen> {
    let (open, surfaces) = (Cell::new(None), [const { Cell::new(Surface::Front) }; 2]);
    let zero = Interval::default();
    setup.damaged([zero, zero], |side, vehicle, origin| {
        let surface = Surface::certainly_along(&setup.collision.crush_plane, &vehicle.heading, origin);
        if surface.is_none() {
            open.set(Some(side));
        }
        surfaces[side as usize].set(surface.unwrap_or(Surface::Front));
        surfaces[side as usize].get()
    });
    open.get().map_or(Ok(surfaces.map(Cell::into_inner)), |side| Err(SurfaceLeftOpen(side)))
}

impl Bounded for BesideImpact<'_> {
    fn numbers(&self) -> usize {
        self.model.parameters().len()
    }

    fn value<T: Real + Copy + From<f64>>(&self, numbers: &[T]) -> T {
        let setup = self.setup(numbers);
        let crush = |side: Side| setup.crush_of(side);
        let value = match self.of {
            CaseOutput::Impact(output) => Some(output.of(&setup.collision, &setup.collision.evaluate())),
            CaseOutput::CrushEnergy(side) => crush(side).map(|crush| crush.energy),
            CaseOutput::EquivalentEnergySpeed(side) => crush(side).map(|crush| crush.equivalent_speed),
            CaseOutput::MeanDepth(side) => crush(side).map(|crush| crush.mean_depth),
            CaseOutput::Crash3(side, key) => self.crash3(&setup, side, key),
            CaseOutput::BrakingSpeed(side) => setup.braking_speed(side),
        };
        value.unwrap_or_else(|| T::from(f64::NAN))
    }

    fn at(&self, point: &[f64]) -> Option<f64> {
        self.model.impact().at(point).solve().ok()?;
        let is_fit = self.model.unfit(point, &self.model.with(point).as_given()).is_none();
        is_fit.then(|| self.value(point))
    }

    fn is_possible(&self, cell: &[Interval]) -> Truth {
        let (setup, zero) = (self.setup(cell), Interval::default());
        let beside = self.model.parameters().iter().zip(cell).filter(|(parameter, _)| is_beside_impact(**parameter));
        let mut is_possible = if self.is_impact_possible { Truth::TRUE } else { self.model.impact().is_possible(cell) };
        is_possible = beside.fold(is_possible, |truth, (parameter, range)| truth & is_within(parameter.domain(), *range));
        for crush in setup.crush.iter().flatten() {
            let widths = crush.profile.segments().map(|segment| zero.less(&segment.width));
            let borders = crush.zones.borders().windows(2).map(|pair| pair[0].less(&pair[1]));
            is_possible = widths.chain(borders).fold(is_possible, |all, each| all & each);
        }
        // Depths themselves are within their domain; those read from a line follow from several numbers.
        let has_line = |vehicle: &VehicleInputs| vehicle.crush.as_ref().is_some_and(|crush| crush.profile.line.is_some());
        let read = self.certain.vehicles.iter().zip(&setup.crush).filter(|(vehicle, _)| vehicle.as_ref().is_some_and(has_line));
        let read = read.filter_map(|(_, crush)| crush.as_ref()).flat_map(|crush| crush.profile.depths());
        is_possible = read.fold(is_possible, |all, depth| all & !depth.less(&zero));
        // Of skids that do not slow the vehicle the sum under the root is below zero.
        setup
            .skid_speeds
            .iter()
            .flatten()
            .fold(is_possible, |all, speed| all & if speed.lower() > 0.0 { Truth::TRUE } else { Truth::UNKNOWN })
    }

    fn is_continuous(&self, _: &[Interval], value: Interval) -> bool {
        // An angle that may have been cut at a half turn.
        !(matches!(self.of, CaseOutput::Crash3(_, Crash3Key::Pdof)) && value.width() > 6.0)
    }

    fn turn_to(&mut self, accepted: &[f64]) {
        if let CaseOutput::Crash3(side, Crash3Key::Pdof) = self.of {
            let setup = self.setup(accepted);
            let pair = setup.damaged([0.0; 2], |side, _, _| self.surfaces[side as usize]);
            self.ahead = [pair.one, pair.two][side as usize].map(|damaged| damaged.force_direction);
        }
    }
}

fn is_within(domain: Domain, range: Interval) -> Truth {
    let [least, greatest] = domain.limits();
    if least <= range.lower() && range.upper() <= greatest {
        Truth::TRUE
    } else if range.upper() < least || greatest < range.lower() {
        Truth::FALSE
    } else {
        Truth::UNKNOWN
    }
}
