//! The keys of `[before]`: what the vehicles did before the impact.

use planar_impact::Side;
use planar_impact::post_impact::{MOST_FRICTION, MOST_GRADE};
use planar_impact::skid::Skid;

use super::CaseReader;
use super::rest::within_grade;
use crate::case::braking::{BrakingInputs, SkidKey, SkidNumber};
use crate::case::parameter::{Parameter, number};
use crate::document::{Field, Table};
use crate::quantity::Kind;

/// Most skids of a vehicle.
const MOST_SKIDS: usize = 32;
/// Longest time from perception to the first skid, in s; none is longer than a few seconds.
const LONGEST_REACTION: f64 = 60.0;

impl CaseReader {
    /// Reads `[before]`: how each party brakes that is a vehicle.
    pub(super) fn before(&self, root: &Table<'_>, is_vehicle: [bool; 2]) -> Option<[Option<BrakingInputs>; 2]> {
        let before = root.optional("before").table()?;
        let field = before.required("vehicle");
        before.finish();
        let tables = field.table()?;
        let mut is_sound = true;
        let mut read = [None, None];
        for (i, (side, key)) in Side::ALL.into_iter().zip(["1", "2"]).enumerate() {
            if !tables.has(key) {
                continue;
            }
            let place = tables.optional(key);
            if is_vehicle[i] {
                read[i] = place.table().and_then(|table| self.braking(&table, side));
            } else {
                place.report(format!("vehicle {} is a fixed barrier, which does not brake", number(side)), None);
            }
            is_sound &= read[i].is_some();
        }
        tables.finish();
        if !tables.has("1") && !tables.has("2") {
            tables.issue("no vehicle", Some("begin with [before.vehicle.1] or [before.vehicle.2]".to_owned()));
            return None;
        }
        is_sound.then_some(read)
    }

    fn braking(&self, table: &Table<'_>, side: Side) -> Option<BrakingInputs> {
        let skids = self.skids(table.required("skid"), side);
        let place = table.optional("reaction_time");
        let reaction_time = table.has("reaction_time").then(|| self.not_negative(place.clone(), Kind::DURATION));
        table.finish();
        let reaction_time = match reaction_time {
            Some(Some(time)) if time > LONGEST_REACTION => {
                let help = format!("write its unit, as in \"{time} ms\"");
                place.report_as("out-of-range", format!("it is {time} s; it must be at most {LONGEST_REACTION} s"), Some(help));
                return None;
            }
            Some(time) => Some(time?),
            None => None,
        };
        Some(BrakingInputs { skids: skids?, reaction_time, gravity: self.gravity() })
    }

    fn skids(&self, field: Field<'_>, side: Side) -> Option<Vec<Skid>> {
        let place = field.clone();
        let tables = field.array_of_tables()?;
        if tables.is_empty() || tables.len() > MOST_SKIDS {
            place.report(format!("{} skids; expected 1 to {MOST_SKIDS}", tables.len()), None);
            return None;
        }
        let read: Vec<Option<Skid>> = tables.iter().zip(1..).map(|(table, skid)| self.skid(table, side, skid)).collect();
        read.into_iter().collect()
    }

    fn skid(&self, table: &Table<'_>, side: Side, skid: usize) -> Option<Skid> {
        let parameter = |of| Parameter::Skid(side, SkidKey { skid, of });
        let usual = |of: SkidNumber, usual: f64| match table.has(of.name()) {
            true => self.input(table.optional(of.name()), parameter(of)),
            false => Some(usual),
        };
        let length = self.input(table.required(SkidNumber::Length.name()), parameter(SkidNumber::Length));
        let friction = self.input(table.required(SkidNumber::Friction.name()), parameter(SkidNumber::Friction));
        let (grade, braking) = (usual(SkidNumber::Grade, 0.0), usual(SkidNumber::Braking, 1.0));
        table.finish();
        let friction = friction.and_then(|friction| self.up_to(&table.optional("friction"), friction, MOST_FRICTION));
        self.warn_of_tires(table, friction);
        let grade = grade.and_then(|grade| within_grade(&table.optional("grade"), grade, -MOST_GRADE));
        let skid = Skid { length: length?, friction: friction?, grade: grade?, braking: braking? };
        let drag = skid.drag_factor();
        if drag > 0.0 {
            return Some(skid);
        }
        let help = "the grade is positive uphill in the direction of travel".to_owned();
        table.issue(format!("the vehicle does not slow down here: friction times braking plus grade is {drag}"), Some(help));
        None
    }
}
