//! From the cells of a row to the numbers of a case file.

use planar_impact::{ForwardLeft, Heading, ImpulseRatio, Input, Law, Moment, Side, Xy};

use super::column::{Cell, Column, InputColumn, Key, NotARow, law_of};
use crate::case::{ContactInputs, CrushInputs, CrushKey, Domain, Inertia, Parameter, Restitution, Size, VehicleInputs, Velocity};
use crate::message::Message;
use crate::quantity::{self, excerpt};
use crate::wording::{joined, ragged};

/// What rows have where their cells are empty; `None` where nothing gives it.
#[derive(Clone, Debug, Default)]
pub struct Defaults {
    /// Vehicle 1 and vehicle 2.
    pub vehicles: [VehicleDefaults; 2],
    /// The angle of the crush plane.
    pub crush_plane: Option<f64>,
    /// The coefficient of restitution.
    pub restitution: Option<f64>,
    /// Whether the case gives it over the closing speed.
    pub has_curve: bool,
    /// The impulse ratio.
    pub impulse_ratio: Option<ImpulseRatio>,
    /// The law of the tangential impulse.
    pub law: Law,
    /// The moment impulse.
    pub moment: Option<Moment>,
}

/// What rows have of a vehicle where their cells are empty; `None` where nothing gives it.
#[derive(Clone, Debug, Default)]
pub struct VehicleDefaults {
    /// Whether it is a fixed barrier.
    pub is_barrier: bool,
    /// The mass.
    pub mass: Option<f64>,
    /// The yaw inertia or the radius of gyration.
    pub inertia: Option<Inertia>,
    /// The heading.
    pub heading: Option<f64>,
    /// The velocity.
    pub velocity: Option<Velocity>,
    /// The yaw rate.
    pub yaw_rate: Option<f64>,
    /// The impact center, forward.
    pub forward: Option<f64>,
    /// The impact center, left.
    pub left: Option<f64>,
}

/// The columns of a vehicle, each with its place among the input columns.
#[derive(Clone, Debug)]
pub(super) struct VehicleColumns {
    side: Side,
    pub(super) has_any: bool,
    pub(super) barrier: Option<usize>,
    pub(super) mass: Option<usize>,
    pub(super) yaw_inertia: Option<usize>,
    pub(super) radius: Option<usize>,
    pub(super) heading: Option<usize>,
    pub(super) speed: Option<usize>,
    pub(super) velocity: [Option<usize>; 2],
    yaw_rate: Option<usize>,
    pub(super) center: [Option<usize>; 2],
    pub(super) crush: Vec<(usize, CrushKey)>,
}

/// The columns of the contact, each with its place among the input columns.
#[derive(Clone, Debug)]
pub(super) struct ContactColumns {
    pub(super) crush_plane: Option<usize>,
    pub(super) restitution: Option<usize>,
    /// The ratio itself, its share of the critical one, the friction.
    pub(super) ratio: [Option<usize>; 3],
    law: Option<usize>,
    pub(super) moment: [Option<usize>; 2],
}

/// The numbers of a vehicle in a row: those that its crush does not add.
#[derive(Clone, Copy, Debug)]
pub(super) struct RowVehicle {
    pub(super) mass: f64,
    pub(super) inertia: Inertia,
    pub(super) heading: f64,
    pub(super) velocity: Velocity,
    pub(super) yaw_rate: f64,
    pub(super) impact_center: ForwardLeft,
}

impl RowVehicle {
    /// Returns the vehicle of a case file that has these numbers and this crush.
    pub(super) fn with_crush(self, crush: Option<CrushInputs>) -> VehicleInputs {
        let RowVehicle { mass, inertia, heading, velocity, yaw_rate, impact_center } = self;
        VehicleInputs { mass, inertia, heading, velocity, yaw_rate, impact_center, crush, size: Size::default(), braking: None }
    }
}

/// Something wrong with a row, before the physics.
#[derive(Clone, Debug)]
pub(super) enum Fault {
    /// The row is not one of the table.
    NotARow(NotARow),
    /// A cell is not what its column needs, with what it is.
    Unreadable(InputColumn, Box<str>),
    /// A number that a case file would not have.
    Outside(Parameter, f64),
    /// A number that no such quantity has, with the unit of its column, or that was probably meant in another unit, without one.
    Implausible { of: Parameter, number: f64, has_unit: bool },
    /// A cell is empty, and nothing else gives its number.
    Missing(Key),
    /// Two cells give the same quantity.
    Conflict(Key, Key),
}

impl Fault {
    fn code(&self) -> &'static str {
        match self {
            Fault::NotARow(_) | Fault::Unreadable(..) => "unreadable",
            Fault::Outside(_, number) if !number.is_finite() => "not-finite",
            Fault::Outside(parameter, _) if parameter.domain() == Domain::Positive => "not-positive",
            Fault::Outside(..) | Fault::Implausible { .. } => "out-of-range",
            Fault::Missing(_) => "missing-key",
            Fault::Conflict(..) => "conflict",
        }
    }

    fn reason(&self) -> Message {
        match self {
            Fault::NotARow(NotARow::Ragged { cells, columns }) => ragged(*cells, *columns).into(),
            Fault::NotARow(NotARow::NotText) => "a cell of the row is not UTF-8 text".into(),
            Fault::Unreadable(column, found) => {
                let key = column.key;
                let wanted = match key {
                    Key::Parameter(Parameter::Input(Input::ImpulseRatio)) => "a number or `critical`",
                    Key::Parameter(_) => "a number, without a unit and with a point",
                    Key::Barrier(_) => "`true` or `false`",
                    Key::Law => "`brach` or `kudlich-slibar`",
                };
                match quantity::finite(found) {
                    // Digits that a float cannot hold.
                    Err(why) if found.parse::<f64>().is_ok() => format!("{key}: {}", why.message).into(),
                    _ => format!("{key} is {}; it must be {wanted}{}", excerpt(found), column.remedy(found)).into(),
                }
            }
            Fault::Outside(parameter, number) => match parameter.domain().wanted(*number).filter(|_| number.is_finite()) {
                // With every digit: rounded, a number beside its limit would be the limit.
                Some(wanted) => {
                    let unit = parameter.kind().si;
                    format!("{parameter} is {number}{}{unit}; it must be {wanted}", if unit.is_empty() { "" } else { " " }).into()
                }
                None => format!("{parameter} is not finite: {number}").into(),
            },
            Fault::Implausible { of, number, has_unit } => {
                let (kind, said) = (of.kind(), Message::from(format!("{of} is ")).figure(of.measure(), *number));
                match (*has_unit || kind.si.is_empty(), kind.likely.first().copied().unwrap_or(kind.si)) {
                    (true, _) if number.abs() < 1.0 => said.text(format!(", too small for {}", kind.name)),
                    (true, _) => said.text(format!(", too large for {}", kind.name)),
                    (false, unit) => {
                        let si = if unit == kind.si { String::new() } else { format!(", or `{of} [{}]` if it is in that", kind.si) };
                        said.text(format!(", which is not plausible without a unit; write the header `{of} [{unit}]`{si}"))
                    }
                }
            }
            Fault::Missing(key) => format!("{key} is missing").into(),
            Fault::Conflict(one, other) => format!("{one} and {other} exclude each other").into(),
        }
    }
}

/// Joins faults in one sentence, and their codes.
pub(super) fn describe(faults: &[Fault]) -> (String, Message) {
    let mut codes: Vec<&str> = faults.iter().map(Fault::code).collect();
    codes.sort_unstable();
    codes.dedup();
    (codes.join(";"), joined(faults.iter().map(Fault::reason)))
}

impl VehicleColumns {
    pub(super) fn of(side: Side, columns: &[InputColumn]) -> Self {
        let place = |key: Key| columns.iter().position(|column| column.key == key);
        let input = |input: fn(Side) -> Input| place(Key::Parameter(Parameter::Input(input(side))));
        let crush = |(i, column): (usize, &InputColumn)| match column.key {
            Key::Parameter(Parameter::Crush(of, key)) if of == side => Some((i, key)),
            _ => None,
        };
        let is_of_side = |column: &InputColumn| match column.key {
            Key::Parameter(parameter) => parameter.side() == Some(side),
            Key::Barrier(of) => of == side,
            Key::Law => false,
        };
        VehicleColumns {
            side,
            has_any: columns.iter().any(is_of_side),
            barrier: place(Key::Barrier(side)),
            mass: input(Input::Mass),
            yaw_inertia: input(Input::YawInertia),
            radius: place(Key::Parameter(Parameter::RadiusOfGyration(side))),
            heading: input(Input::Heading),
            speed: place(Key::Parameter(Parameter::Speed(side))),
            velocity: [input(Input::VelocityX), input(Input::VelocityY)],
            yaw_rate: input(Input::YawRate),
            center: [input(Input::ImpactCenterForward), input(Input::ImpactCenterLeft)],
            crush: columns.iter().enumerate().filter_map(crush).collect(),
        }
    }
}

impl ContactColumns {
    pub(super) fn of(columns: &[InputColumn]) -> Self {
        let place = |key: Key| columns.iter().position(|column| column.key == key);
        let parameter = |parameter: Parameter| place(Key::Parameter(parameter));
        let input = |input: Input| parameter(Parameter::Input(input));
        ContactColumns {
            crush_plane: input(Input::CrushPlane),
            restitution: input(Input::Restitution),
            ratio: [input(Input::ImpulseRatio), parameter(Parameter::RatioOfCritical), parameter(Parameter::Friction)],
            law: place(Key::Law),
            moment: [input(Input::Moment), parameter(Parameter::MomentOfCritical)],
        }
    }
}

/// A row whose cells are being read.
pub(super) struct Row<'a> {
    pub(super) keys: &'a [InputColumn],
    pub(super) columns: &'a [Column<'a>],
    pub(super) row: usize,
    pub(super) faults: Vec<Fault>,
}

impl Row<'_> {
    #[inline]
    fn cell(&self, column: Option<usize>) -> Cell {
        column.map_or(Cell::Empty, |column| self.columns[column].at(self.row))
    }

    /// Returns the number of a cell, if it is filled in.
    #[inline]
    fn given(&mut self, column: Option<usize>) -> Option<f64> {
        let column = column?;
        match self.columns[column].at(self.row) {
            Cell::Number(number) if self.keys[column].accepts(number) => Some(number),
            Cell::Empty => None,
            wrong => Some(self.wrong(column, wrong)),
        }
    }

    #[cold]
    #[inline(never)]
    fn wrong(&mut self, column: usize, cell: Cell) -> f64 {
        let column = self.keys[column];
        self.faults.push(match (cell, column.key) {
            (Cell::Number(number), Key::Parameter(of)) if number.is_finite() && of.domain().wanted(number).is_none() => {
                Fault::Implausible { of, number, has_unit: column.has_unit() }
            }
            (Cell::Number(number), Key::Parameter(parameter)) => Fault::Outside(parameter, number),
            (Cell::Number(number), _) => Fault::Unreadable(column, number.to_string().into()),
            (Cell::Unreadable(found), _) => Fault::Unreadable(column, found),
            (Cell::Critical, _) => Fault::Unreadable(column, "critical".into()),
            (Cell::Empty, _) => Fault::Unreadable(column, "".into()),
        });
        f64::NAN
    }

    /// Returns the number of a cell, or else the default.
    #[inline]
    fn number(&mut self, column: Option<usize>, default: Option<f64>, of: impl FnOnce() -> Parameter) -> f64 {
        self.given(column).or(default).unwrap_or_else(|| self.lacks(of()))
    }

    #[cold]
    fn lacks(&mut self, of: Parameter) -> f64 {
        self.faults.push(Fault::Missing(Key::Parameter(of)));
        f64::NAN
    }

    #[cold]
    fn conflict(&mut self, one: Option<usize>, other: Option<usize>) {
        if let (Some(one), Some(other)) = (one, other) {
            self.faults.push(Fault::Conflict(self.keys[one].key, self.keys[other].key));
        }
    }

    /// Returns a vehicle, or `None` for a fixed barrier.
    pub(super) fn vehicle(&mut self, of: &VehicleColumns, default: &VehicleDefaults) -> Option<RowVehicle> {
        let side = of.side;
        if self.given(of.barrier).map_or(default.is_barrier, |truth| truth == 1.0) {
            self.nothing_else(of);
            return None;
        }
        let input = |input: fn(Side) -> Input| move || Parameter::Input(input(side));
        let mass = self.number(of.mass, default.mass, input(Input::Mass));
        let heading = self.number(of.heading, default.heading, input(Input::Heading));
        let inertia = match (self.given(of.yaw_inertia), self.given(of.radius)) {
            (Some(inertia), None) => Inertia::Yaw(inertia),
            (None, Some(radius)) => Inertia::Radius(radius),
            (Some(inertia), Some(_)) => {
                self.conflict(of.yaw_inertia, of.radius);
                Inertia::Yaw(inertia)
            }
            (None, None) => default.inertia.unwrap_or_else(|| Inertia::Yaw(self.lacks(Parameter::Input(Input::YawInertia(side))))),
        };
        let velocity = self.velocity(of, default, heading);
        Some(RowVehicle {
            mass,
            inertia,
            heading,
            velocity,
            yaw_rate: self.number(of.yaw_rate, default.yaw_rate, input(Input::YawRate)),
            impact_center: ForwardLeft {
                forward: self.number(of.center[0], default.forward, input(Input::ImpactCenterForward)),
                left: self.number(of.center[1], default.left, input(Input::ImpactCenterLeft)),
            },
        })
    }

    /// Returns the crush of a vehicle, from the one that rows have where their cells are empty.
    pub(super) fn crush(&mut self, of: &VehicleColumns, default: &CrushInputs) -> CrushInputs {
        let mut crush = default.clone();
        let given: Vec<(usize, CrushKey, f64)> =
            of.crush.iter().filter_map(|&(column, key)| Some((column, key, self.given(Some(column))?))).collect();
        for (i, &(column, key, number)) in given.iter().enumerate() {
            match given[..i].iter().find(|(_, other, _)| key.excludes(*other)) {
                Some((other, ..)) => self.conflict(Some(*other), Some(column)),
                None => crush.set(key, number),
            }
        }
        crush
    }

    fn velocity(&mut self, of: &VehicleColumns, default: &VehicleDefaults, heading: f64) -> Velocity {
        let (speed, x, y) = (self.given(of.speed), self.given(of.velocity[0]), self.given(of.velocity[1]));
        if let Some(speed) = speed {
            for (component, column) in [x, y].into_iter().zip(of.velocity) {
                if component.is_some() {
                    self.conflict(of.speed, column);
                }
            }
            return Velocity::Speed(speed);
        }
        if x.is_none() && y.is_none() {
            return default.velocity.unwrap_or_else(|| Velocity::Speed(self.lacks(Parameter::Speed(of.side))));
        }
        let other = match default.velocity {
            Some(Velocity::Speed(speed)) => Some(Heading::from_angle(heading).to_ground(ForwardLeft { forward: speed, left: 0.0 })),
            Some(Velocity::Components(velocity)) => Some(velocity),
            None => None,
        };
        let [or_x, or_y] = [other.map(|other| other.x), other.map(|other| other.y)];
        Velocity::Components(Xy {
            x: x.or(or_x).unwrap_or_else(|| self.lacks(Parameter::Input(Input::VelocityX(of.side)))),
            y: y.or(or_y).unwrap_or_else(|| self.lacks(Parameter::Input(Input::VelocityY(of.side)))),
        })
    }

    /// Refuses every number of a barrier.
    fn nothing_else(&mut self, of: &VehicleColumns) {
        let numbers = [of.mass, of.yaw_inertia, of.radius, of.heading, of.speed, of.yaw_rate].into_iter();
        let others = numbers.chain(of.velocity).chain(of.center).chain(of.crush.iter().map(|(column, _)| Some(*column)));
        for column in others {
            if self.cell(column) != Cell::Empty {
                self.conflict(of.barrier, column);
            }
        }
    }

    /// Returns the contact.
    pub(super) fn contact(&mut self, of: &ContactColumns, default: &Defaults) -> ContactInputs {
        let law = self.given(of.law).map_or(default.law, law_of);
        ContactInputs {
            crush_plane: self.number(of.crush_plane, default.crush_plane, || Parameter::Input(Input::CrushPlane)),
            restitution: Restitution::Given(self.number(of.restitution, default.restitution, || Parameter::Input(Input::Restitution))),
            impulse_ratio: self.impulse_ratio(of, default),
            law,
            moment: self.moment(of, default),
        }
    }

    fn impulse_ratio(&mut self, of: &ContactColumns, default: &Defaults) -> ImpulseRatio {
        let forms: [fn(f64) -> ImpulseRatio; 3] = [ImpulseRatio::Given, ImpulseRatio::OfCritical, ImpulseRatio::LimitedByFriction];
        let mut found: Option<(Option<usize>, ImpulseRatio)> = None;
        for (column, form) in of.ratio.into_iter().zip(forms) {
            let is_critical = column == of.ratio[0] && self.cell(column) == Cell::Critical;
            let ratio = if is_critical { Some(ImpulseRatio::Critical) } else { self.given(column).map(form) };
            match (ratio, &found) {
                (Some(_), Some((other, _))) => self.conflict(*other, column),
                (Some(ratio), None) => found = Some((column, ratio)),
                (None, _) => (),
            }
        }
        let default = || default.impulse_ratio;
        found.map(|(_, ratio)| ratio).or_else(default).unwrap_or_else(|| {
            self.lacks(Parameter::Input(Input::ImpulseRatio));
            ImpulseRatio::Critical
        })
    }

    fn moment(&mut self, of: &ContactColumns, default: &Defaults) -> Moment {
        match of.moment.map(|column| self.given(column)) {
            [Some(moment), None] => Moment::Given(moment),
            [None, Some(share)] => Moment::OfCritical(share),
            [Some(_), Some(_)] => {
                self.conflict(of.moment[0], of.moment[1]);
                Moment::None
            }
            [None, None] => default.moment.unwrap_or_else(|| {
                self.lacks(Parameter::Input(Input::Moment));
                Moment::None
            }),
        }
    }
}
