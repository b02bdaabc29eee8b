//! The crush of a vehicle: as a case file gives it, and on any scalar type.

mod key;
mod stiffness;

use planar_impact::crash3::Surface;
use planar_impact::crush::{CrushLaw, CrushStiffness, MeasuringLine, Profile, ProfileError, Saturating, StiffnessZones};
use planar_impact::{ForceDirection, Real};

use crate::quantity::Kind;

pub use key::{CrushKey, FormKey};
pub use stiffness::StiffnessInputs;

/// The shape of a crush, in SI.
#[derive(Clone, Debug, PartialEq)]
pub struct ProfileInputs {
    /// Positions of the depths along the width.
    pub places: Places,
    /// The depths as read, two or more.
    pub depths: Vec<f64>,
    /// The measuring line, unless depths are measured from the undeformed surface.
    pub line: Option<MeasuringLine>,
}

/// A crush of a case file, in SI.
#[derive(Clone, Debug, PartialEq)]
pub struct CrushInputs {
    /// Profile of the crush.
    pub profile: ProfileInputs,
    /// The stiffness of each zone, one or more.
    pub stiffness: Vec<StiffnessInputs>,
    /// Positions where one zone ends and the next begins.
    pub borders: Vec<f64>,
    /// Depth beyond which the force is constant; allowed only with one zone.
    pub saturation: Option<f64>,
    /// The crushed surface, if the file gives it.
    pub surface: Option<Surface>,
    /// The investigator's principal direction of force, if the file gives it.
    pub pdof: Option<f64>,
}

/// Positions of the measured depths.
#[derive(Clone, Debug, PartialEq)]
pub enum Places {
    /// Equally spaced over a width.
    Width(f64),
    /// At stations.
    Stations(Vec<f64>),
}

/// The crush of a vehicle, on any scalar type.
#[derive(Clone, Debug, PartialEq)]
pub struct Crush<T = f64> {
    /// Profile of the crush.
    pub profile: Profile<T>,
    /// Stiffness along the width.
    pub zones: StiffnessZones<T>,
    /// Depth beyond which the force is constant.
    pub saturation: Option<T>,
    /// The crushed surface, if the file gives it.
    pub surface: Option<Surface>,
    /// Direction the principal force comes from, if the file gives it.
    pub force_direction: Option<ForceDirection<T>>,
}

impl ProfileInputs {
    /// Returns the profile on any scalar type, adding `by` of its key to each number.
    pub fn on_scalar<T: Real + From<f64>>(&self, mut by: impl FnMut(CrushKey) -> T) -> Profile<T> {
        self.plus(&mut |value, key| T::from(value) + by(key))
    }

    fn plus<T: Real>(&self, plus: &mut impl FnMut(f64, CrushKey) -> T) -> Profile<T> {
        let depths: Vec<T> = self.depths.iter().enumerate().map(|(i, &depth)| plus(depth, CrushKey::Depth(i + 1))).collect();
        let given = match &self.places {
            Places::Width(width) => Profile::equally_spaced_unchecked(plus(*width, CrushKey::Width), depths),
            Places::Stations(stations) => {
                let stations = stations.iter().enumerate().map(|(i, &station)| plus(station, CrushKey::Station(i + 1))).collect();
                Profile::at_stations_unchecked(stations, depths)
            }
        };
        let given = given.ok().expect("two depths or more, and as many stations");
        match self.line {
            None => given,
            Some(line) => {
                let line = MeasuringLine { offset: plus(line.offset, CrushKey::Offset), angle: plus(line.angle, CrushKey::Angle) };
                line.profile_unchecked(&given.stations(), given.depths()).ok().expect("as many stations as depths")
            }
        }
    }
}

impl CrushInputs {
    /// Returns the keys of all numbers of this crush, in file order.
    pub fn keys(&self) -> Vec<CrushKey> {
        let mut all = match &self.profile.places {
            Places::Width(_) => vec![CrushKey::Width],
            Places::Stations(stations) => (1..=stations.len()).map(CrushKey::Station).collect(),
        };
        all.extend((1..=self.profile.depths.len()).map(CrushKey::Depth));
        if self.profile.line.is_some() {
            all.extend([CrushKey::Offset, CrushKey::Angle]);
        }
        if self.stiffness.len() == 1 {
            all.extend([CrushKey::Onset, CrushKey::Slope]);
        } else {
            for zone in 1..=self.stiffness.len() {
                all.extend([CrushKey::ZoneOnset(zone), CrushKey::ZoneSlope(zone)]);
                all.extend((zone <= self.borders.len()).then_some(CrushKey::ZoneEnd(zone)));
            }
        }
        all.extend(self.saturation.is_some().then_some(CrushKey::Saturation));
        all.extend(self.pdof.is_some().then_some(CrushKey::Pdof));
        all
    }

    /// Returns the value of a key.
    ///
    /// # Errors
    ///
    /// Returns a message if this crush has no such key.
    pub fn value(&self, key: CrushKey) -> Result<f64, String> {
        let root = |zone: usize, of: fn(&CrushStiffness) -> f64| self.stiffness.get(zone).map(|zone| of(&zone.roots()));
        let value = match self.root(key) {
            Some((zone, Root::Onset)) => root(zone, |roots| roots.onset),
            Some((zone, Root::Slope)) => root(zone, |roots| roots.slope),
            None => self.clone().place(key).map(|place| *place),
        };
        value.ok_or_else(|| self.lacks(key))
    }

    /// Sets the value of a key.
    ///
    /// # Panics
    ///
    /// Panics if this crush has no such key.
    pub fn set(&mut self, key: CrushKey, value: f64) {
        match self.root(key) {
            Some((zone, Root::Onset)) => self.stiffness[zone].set_roots(|roots| roots.onset = value),
            Some((zone, Root::Slope)) => self.stiffness[zone].set_roots(|roots| roots.slope = value),
            None => *self.place(key).expect("a value can be set") = value,
        }
    }

    /// Returns the index of a zone and which of d0 and d1 a key is; `None` for any other key, or if the crush has no such zone.
    fn root(&self, key: CrushKey) -> Option<(usize, Root)> {
        let zones = self.stiffness.len();
        let found = match key {
            CrushKey::Onset if zones == 1 => (0, Root::Onset),
            CrushKey::Slope if zones == 1 => (0, Root::Slope),
            CrushKey::ZoneOnset(zone) if zones > 1 => (zone.checked_sub(1)?, Root::Onset),
            CrushKey::ZoneSlope(zone) if zones > 1 => (zone.checked_sub(1)?, Root::Slope),
            _ => return None,
        };
        (found.0 < zones).then_some(found)
    }

    fn lacks(&self, key: CrushKey) -> String {
        match key {
            CrushKey::Width => "the case gives `stations` instead".to_owned(),
            CrushKey::Station(_) if matches!(self.profile.places, Places::Width(_)) => "the case gives `width` instead".to_owned(),
            CrushKey::Station(_) | CrushKey::Depth(_) => format!("the crush has {} depths", self.profile.depths.len()),
            CrushKey::Form(_) if self.stiffness.len() == 1 => {
                "the case gives the stiffness in another form; name the numbers that it gives".to_owned()
            }
            CrushKey::ZoneForm(zone, _) if (2..).contains(&self.stiffness.len()) && (1..=self.stiffness.len()).contains(&zone) => {
                format!("the case gives the stiffness of zone {zone} in another form")
            }
            CrushKey::Onset | CrushKey::Slope | CrushKey::Form(_) => {
                format!("the crush has {} zones: crush.zones.1.d0, crush.zones.1.d1, ...", self.stiffness.len())
            }
            CrushKey::ZoneOnset(_) | CrushKey::ZoneSlope(_) | CrushKey::ZoneEnd(_) | CrushKey::ZoneForm(..) => match self.stiffness.len() {
                1 => "the crush has no zones: crush.d0, crush.d1".to_owned(),
                count => format!("the crush has {count} zones"),
            },
            CrushKey::Offset | CrushKey::Angle => "the case does not say from where the depths are measured".to_owned(),
            CrushKey::Saturation => "the case has no saturation".to_owned(),
            CrushKey::Pdof => "the case leaves the principal direction of force to the mechanics".to_owned(),
        }
    }

    fn place(&mut self, key: CrushKey) -> Option<&mut f64> {
        let item = |place: usize| place.checked_sub(1);
        let zones = self.stiffness.len();
        match key {
            CrushKey::Width => match &mut self.profile.places {
                Places::Width(width) => Some(width),
                Places::Stations(_) => None,
            },
            CrushKey::Station(place) => match &mut self.profile.places {
                Places::Stations(stations) => stations.get_mut(item(place)?),
                Places::Width(_) => None,
            },
            CrushKey::Depth(place) => self.profile.depths.get_mut(item(place)?),
            CrushKey::Offset => self.profile.line.as_mut().map(|line| &mut line.offset),
            CrushKey::Angle => self.profile.line.as_mut().map(|line| &mut line.angle),
            CrushKey::Form(key) if zones == 1 => self.stiffness[0].place(key),
            CrushKey::ZoneForm(zone, key) if zones > 1 => self.stiffness.get_mut(item(zone)?)?.place(key),
            CrushKey::ZoneEnd(zone) => self.borders.get_mut(item(zone)?),
            CrushKey::Saturation => self.saturation.as_mut(),
            CrushKey::Pdof => self.pdof.as_mut(),
            _ => None,
        }
    }

    /// Returns the crush on any scalar type, adding `by` of its key to each number.
    pub fn on_scalar<T: Real + From<f64>>(&self, mut by: impl FnMut(CrushKey) -> T) -> Crush<T> {
        let one_zone = self.stiffness.len() == 1;
        let zones = self.stiffness.iter().enumerate().map(|(i, zone)| {
            let roots = zone.on_scalar(|key| by(if one_zone { CrushKey::Form(key) } else { CrushKey::ZoneForm(i + 1, key) }));
            let (onset, slope) =
                if one_zone { (CrushKey::Onset, CrushKey::Slope) } else { (CrushKey::ZoneOnset(i + 1), CrushKey::ZoneSlope(i + 1)) };
            CrushStiffness { onset: roots.onset + by(onset), slope: roots.slope + by(slope) }
        });
        let zones = zones.collect();
        let mut plus = |value: f64, key| T::from(value) + by(key);
        let profile = self.profile.plus(&mut plus);
        let borders = self.borders.iter().enumerate().map(|(i, &border)| plus(border, CrushKey::ZoneEnd(i + 1))).collect();
        Crush {
            profile,
            zones: StiffnessZones::new(zones, borders).expect("a border between two zones"),
            saturation: self.saturation.map(|depth| plus(depth, CrushKey::Saturation)),
            surface: self.surface,
            force_direction: self.pdof.map(|pdof| {
                let (right, ahead) = plus(pdof, CrushKey::Pdof).sin_and_cos();
                ForceDirection { ahead, right }
            }),
        }
    }
}

/// One of the two numbers of a stiffness.
#[derive(Clone, Copy)]
enum Root {
    Onset,
    Slope,
}

/// Formats a profile error as a sentence, counting depths and stations from 1 as in a file.
pub fn sentence(error: &ProfileError) -> String {
    match error {
        ProfileError::Input(issue) => match issue.at.index {
            Some(index) => issue.sentence(format!("{} {}", issue.at.name.trim_end_matches('s'), index + 1)).to_string(),
            None => error.to_string(),
        },
        _ => error.to_string(),
    }
}

/// Returns why a stiffness is larger than a case file may give it, be it in another form.
pub fn too_stiff(&CrushStiffness { onset, slope }: &CrushStiffness) -> Option<String> {
    let holds = Kind::ROOT_FORCE.domain.holds(onset) && Kind::ROOT_FORCE_PER_LENGTH.domain.holds(slope);
    (!holds).then(|| format!("it is too large: d0 would be {onset:.3e} N^0.5 and d1 {slope:.3e} N^0.5/m"))
}

impl Crush {
    /// Returns why this crush is physically impossible, or `None` if it is possible. A file with such a crush is
    /// refused, but a sweep can reach one.
    pub fn unfit(&self) -> Option<String> {
        let errors = self.profile.clone().checked().err();
        let borders = self.zones.borders().windows(2).filter(|pair| pair[1] <= pair[0]);
        let borders = borders.map(|pair| format!("a zone ends at {} m, not beyond the one before, at {} m", pair[1], pair[0]));
        let stiffness = self.zones.zones().iter().filter_map(too_stiff).map(|why| format!("the stiffness: {why}"));
        let all: Vec<String> = errors.iter().flatten().map(sentence).chain(borders).chain(stiffness).collect();
        (!all.is_empty()).then(|| all.join("; "))
    }
}

impl<T: Real> Crush<T> {
    /// Computes the crush energy.
    pub fn energy(&self) -> T {
        match &self.saturation {
            None => self.zones.crush_energy(&self.profile),
            Some(depth) => Saturating { stiffness: self.zones.zones()[0].clone(), depth: depth.clone() }.energy_of(&self.profile),
        }
    }
}

impl Crush {
    /// Computes the force normal to the surface at the end of the crush.
    pub fn force(&self) -> f64 {
        match self.saturation {
            None => self.zones.crush_force(&self.profile),
            Some(depth) => Saturating { stiffness: self.zones.zones()[0], depth }.crush_force(&self.profile),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use planar_impact::crush::{BarrierSpeedLine, ForceLine};

    fn crush() -> CrushInputs {
        CrushInputs {
            profile: ProfileInputs {
                places: Places::Stations(vec![0.0, 0.5, 1.5]),
                depths: vec![0.25, 0.5, 0.125],
                line: Some(MeasuringLine { offset: 0.0625, angle: 0.25 }),
            },
            stiffness: vec![CrushStiffness { onset: 3.0, slope: 4.0 }.into(), CrushStiffness { onset: 5.0, slope: 6.0 }.into()],
            borders: vec![0.75],
            saturation: None,
            surface: None,
            pdof: Some(0.5),
        }
    }

    #[test]
    fn every_key_has_a_value_and_takes_another() {
        let one_zone = CrushInputs {
            profile: ProfileInputs { places: Places::Width(1.5), ..crush().profile },
            stiffness: vec![CrushStiffness { onset: 3.0, slope: 4.0 }.into()],
            borders: vec![],
            saturation: Some(0.25),
            ..crush()
        };
        for crush in [crush(), one_zone] {
            for key in crush.keys() {
                let before = crush.value(key).expect("it has it");
                let mut set = crush.clone();
                set.set(key, before + 0.25);
                assert_eq!(set.value(key), Ok(before + 0.25), "{key}");
                let added = crush.on_scalar(|other| if other == key { 0.25 } else { 0.0 });
                assert_eq!(set.on_scalar(|_| 0.0), added, "{key}");
                assert_ne!(crush.on_scalar(|_| 0.0), added, "{key}");
            }
        }
    }

    #[test]
    fn every_number_of_a_form_has_a_value_and_takes_another() {
        let force = StiffnessInputs::Force(ForceLine { onset: 3.0, slope: 4.0 });
        let speed = StiffnessInputs::Speed(BarrierSpeedLine { onset: 1.5, slope: 2.0, test_mass: 8.0, test_width: 2.0 });
        assert_eq!(force.roots(), CrushStiffness { onset: 1.5, slope: 2.0 });
        assert_eq!(speed.roots(), CrushStiffness { onset: 3.0, slope: 4.0 });
        let zones = CrushInputs { stiffness: vec![force, speed], ..crush() };
        let one = |form: StiffnessInputs| CrushInputs { stiffness: vec![form], borders: vec![], ..crush() };
        use FormKey::*;
        let of_speed = [SpeedOnset, SpeedSlope, TestMass, TestWidth];
        let mut all: Vec<(CrushInputs, CrushKey)> = [ForceOnset, ForceSlope].map(|key| (one(force), CrushKey::Form(key))).into();
        all.extend(of_speed.map(|key| (one(speed), CrushKey::Form(key))));
        all.extend([ForceOnset, ForceSlope].map(|key| (zones.clone(), CrushKey::ZoneForm(1, key))));
        all.extend(of_speed.map(|key| (zones.clone(), CrushKey::ZoneForm(2, key))));
        for (crush, key) in all {
            let before = crush.value(key).expect("it has it");
            let mut set = crush.clone();
            set.set(key, before + 0.25);
            let added = crush.on_scalar(|other| if other == key { 0.25 } else { 0.0 });
            assert_eq!((set.value(key), set.on_scalar(|_| 0.0)), (Ok(before + 0.25), added.clone()), "{key}");
            assert_ne!(crush.on_scalar(|_| 0.0), added, "{key}");
        }
        // A new d0 replaces the form, and keeps d1.
        let mut set = zones.clone();
        set.set(CrushKey::ZoneOnset(1), 7.0);
        assert_eq!(set.stiffness, [CrushStiffness { onset: 7.0, slope: 2.0 }.into(), speed]);
        assert_eq!((zones.value(CrushKey::ZoneOnset(1)), zones.value(CrushKey::ZoneSlope(2))), (Ok(1.5), Ok(4.0)));
        for (crush, key, why) in [
            (one(force), CrushKey::Form(SpeedOnset), "another form"),
            (zones.clone(), CrushKey::ZoneForm(1, TestMass), "another form"),
            (zones.clone(), CrushKey::ZoneForm(3, TestMass), "2 zones"),
            (zones, CrushKey::Form(ForceOnset), "2 zones"),
        ] {
            assert!(crush.value(key).is_err_and(|text| text.contains(why)), "{key}");
        }
    }

    #[test]
    fn what_it_has_not_it_says() {
        for (key, why) in [
            (CrushKey::Width, "stations"),
            (CrushKey::Station(4), "3 depths"),
            (CrushKey::Depth(0), "3 depths"),
            (CrushKey::Onset, "2 zones"),
            (CrushKey::ZoneSlope(3), "2 zones"),
            (CrushKey::ZoneEnd(2), "2 zones"),
            (CrushKey::Saturation, "no saturation"),
        ] {
            assert!(crush().value(key).is_err_and(|text| text.contains(why)), "{key}");
        }
    }
}
