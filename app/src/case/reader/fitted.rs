//! The key `stiffness.tests`: a stiffness that is fitted to the barrier tests of another file, with its covariance.

use std::path::Path;

use planar_impact::Distribution;
use planar_impact::barrier::{CovarianceBasis, CrushModel, StiffnessCovariance, StiffnessFit};
use planar_impact::crush::CrushStiffness;

use super::CaseReader;
use crate::case::parameter::Parameter;
use crate::case::uncertain::{InputCorrelation, UncertainInput};
use crate::document::{Field, Table};
use crate::issue::Issues;
use crate::message::Message;
use crate::notice::{Notice, Notices};
use crate::source::Source;
use crate::stiffness::{FurtherVehicle, Pooled, TestFile, is_negative, message, wider_than_normal};
use crate::units::{Measure, Units};
use crate::wording::degrees_of_freedom;

/// A stiffness fitted to the tests of a file, and what has it.
pub(super) struct FittedToTests {
    tests: Source,
    model: CrushModel,
    fit: StiffnessFit,
    is_uncertain: bool,
    /// The number of vehicles of the file.
    vehicles: usize,
    /// Their class, whose spread is in the covariance.
    class: Option<Pooled>,
    /// By how much the standard deviations are enlarged: those that residuals give, because few of them tell little, and those that residuals contradict to what these
    /// give.
    enlarged: Option<f64>,
    /// The part of the covariance that two vehicles of the class share.
    common: StiffnessCovariance,
    /// d0 and d1 of each crush or zone with this stiffness, and the path of its key.
    of: Vec<([Parameter; 2], String)>,
}

impl CaseReader {
    /// Reads a stiffness that is fitted to tests, and keeps d0 and d1 as uncertain inputs.
    pub(super) fn fitted(&self, table: &Table<'_>, of: [Parameter; 2]) -> Option<CrushStiffness> {
        let model = match table.optional("model").choice(&["profile", "mean depth"]) {
            Some("mean depth") => CrushModel::MeanDepth,
            _ => CrushModel::Profile,
        };
        let field = table.required("tests");
        let (key, place) = (field.path().to_owned(), field.clone());
        let name = place.clone().string()?.to_owned();
        let tests = self.opened(field, "give d0 and d1 as `planar-impact stiffness` prints them")?;
        let mut all = self.fitted.borrow_mut();
        let known = match all.iter().position(|known| known.tests.text == tests.text) {
            Some(known) if all[known].model != model => {
                let help = format!("give the model of {}", all[known].of[0].1);
                table.optional("model").report("the same tests are fitted to another model of the crush", Some(help));
                return None;
            }
            Some(known) => &mut all[known],
            None => {
                let reader = self.beside(&name);
                let (fitted, notices) = FittedToTests::of(tests, model, reader).map_err(|issues| report(&place, &issues)).ok()?;
                let of_key = |notice: Notice| Notice {
                    message: Message::from(format!("{key}: ")).join(notice.message),
                    path: key.clone(),
                    ..notice
                };
                self.notices.borrow_mut().extend(notices.0.into_iter().map(of_key));
                all.push(fitted);
                all.last_mut()?
            }
        };
        known.of.push((of, key.clone()));
        if let Some(finding) = known.fit.findings().into_iter().find(is_negative) {
            place.report(Units::Si.sentence(&message(&finding)), Some("`planar-impact stiffness` shows the fit".to_owned()));
            return None;
        }
        self.notices.borrow_mut().push(known.notice(&key));
        let CrushStiffness { onset, slope } = known.fit.stiffness;
        if known.is_uncertain {
            let sds = [known.fit.onset().deviation(), known.fit.slope().deviation()];
            for ((parameter, nominal), sd) in of.into_iter().zip([onset, slope]).zip(sds).filter(|(_, sd)| *sd > 0.0) {
                let distribution = Distribution::Normal { mean: nominal, sd };
                let is_for_95 = known.enlarged.is_some() || known.class.is_some();
                self.uncertain.borrow_mut().push(UncertainInput {
                    parameter,
                    key: key.clone(),
                    nominal,
                    distribution,
                    values: None,
                    is_for_95,
                });
            }
        }
        Some(known.fit.stiffness)
    }

    /// Opens the file that a field names. `instead` is what to do in a case that cannot name one.
    pub(super) fn opened(&self, field: Field<'_>, instead: &str) -> Option<Source> {
        let place = field.clone();
        let name = field.string()?;
        let Some(open) = &self.open else {
            place.report("a case that is not read from a file cannot name another one", Some(instead.to_owned()));
            return None;
        };
        open(name).map_err(|issues| report(&place, &issues)).ok()
    }

    /// Returns a reader of a file that this one names, which may itself name files that lie beside it.
    fn beside(&self, name: &str) -> CaseReader {
        let Some(open) = self.open.clone() else { return CaseReader::default() };
        let folder = Path::new(name).parent().map(Path::to_path_buf).unwrap_or_default();
        CaseReader::opening(Box::new(move |name| open(&folder.join(name).to_string_lossy())))
    }

    /// Opens a file that another file names.
    pub(super) fn open_at(&self, path: &Path) -> Result<Source, Issues> {
        match &self.open {
            Some(open) => open(&path.to_string_lossy()),
            None => Err(Issues::defect("a file cannot be opened here")),
        }
    }

    /// Returns `true` if an input is fitted to tests.
    pub(super) fn is_fitted(&self, parameter: Parameter) -> bool {
        self.fitted.borrow().iter().flat_map(|fitted| &fitted.of).any(|(of, _)| of.contains(&parameter))
    }

    /// Returns the correlations of the inputs that are fitted to tests.
    pub(super) fn correlations_of_tests(&self) -> Vec<InputCorrelation> {
        self.fitted.borrow().iter().filter(|fitted| fitted.is_uncertain).flat_map(FittedToTests::correlations).collect()
    }
}

impl FittedToTests {
    /// Fits a stiffness to the tests of a file. What the recordings that it names are to be known for comes with it.
    fn of(tests: Source, model: CrushModel, reader: CaseReader) -> Result<(Self, Notices), Issues> {
        let mut file = TestFile::read(tests.clone(), reader)?;
        let mut fit = file.fit(model)?;
        let is_uncertain = file.is_uncertain(&fit);
        let (vehicles, class) = (file.vehicles.len(), file.class(model));
        let freedom = u32::try_from(fit.degrees_of_freedom).unwrap_or(u32::MAX - 1);
        let enlarged = match fit.basis {
            _ if !is_uncertain || class.is_some() || freedom == 0 => None,
            CovarianceBasis::Residuals => Some(wider_than_normal(freedom + 1)),
            // Birge (1932): by the residuals, where the standard deviations are too small for them.
            _ => fit.is_poor().then(|| (fit.chi_square / f64::from(freedom)).sqrt()),
        };
        let FurtherVehicle { fit, common } = match &class {
            Some(class) => class.further_vehicle(fit),
            None => {
                if let Some(factor) = enlarged {
                    let StiffnessCovariance { onset, between, slope } = &mut fit.covariance;
                    [onset, between, slope].into_iter().for_each(|entry| *entry *= factor * factor);
                }
                FurtherVehicle { common: fit.covariance, fit }
            }
        };
        let notices = std::mem::take(&mut file.notices);
        Ok((FittedToTests { tests, model, fit, is_uncertain, vehicles, class, enlarged, common, of: Vec::new() }, notices))
    }

    /// Pairs d0 and d1 of everything that has this stiffness: the same number of two crushes of a vehicle is one number, and two vehicles of a class share the
    /// error of the line through all tests.
    fn correlations(&self) -> Vec<InputCorrelation> {
        let of_one_vehicle = self.fit.covariance;
        let coefficient = |one: &(usize, Parameter, &str), other: &(usize, Parameter, &str)| {
            let shared = if one.1.side() == other.1.side() { of_one_vehicle } else { self.common };
            let entry = |of: &StiffnessCovariance, one: usize, other: usize| match (one, other) {
                (0, 0) => of.onset,
                (1, 1) => of.slope,
                _ => of.between,
            };
            let variance = |of: usize| entry(&of_one_vehicle, of, of);
            entry(&shared, one.0, other.0) / (variance(one.0) * variance(other.0)).sqrt()
        };
        let inputs: Vec<(usize, Parameter, &str)> =
            self.of.iter().flat_map(|(of, key)| of.iter().enumerate().map(move |(i, parameter)| (i, *parameter, key.as_str()))).collect();
        // A d0 that is held is certain.
        let is_held = self.fit.covariance.onset <= 0.0;
        let inputs: Vec<_> = inputs.into_iter().filter(|(i, ..)| !is_held || *i == 1).collect();
        let pairs = inputs.iter().enumerate().flat_map(|(i, one)| inputs[i + 1..].iter().map(move |other| (one, other)));
        pairs
            .map(|(one, other)| InputCorrelation {
                one: one.1,
                other: other.1,
                coefficient: coefficient(one, other),
                key: other.2.to_owned(),
            })
            .collect()
    }

    fn notice(&self, key: &str) -> Notice {
        let number = |message: Message, measure, value, sd| {
            let message = message.figure(measure, value);
            if self.is_uncertain { message.text(" ± ").figure(measure, sd) } else { message }
        };
        let (onset, slope) = (self.fit.onset(), self.fit.slope());
        let message = number(Message::from(format!("{key}: d0 = ")), Measure::RootForce, onset.value, onset.deviation());
        let message = number(message.text(", d1 = "), Measure::RootForcePerLength, slope.value, slope.deviation());
        let count = self.fit.residuals.len();
        let vehicles = self.vehicles;
        if let Some(class) = &self.class {
            let those = if class.vehicles.len() < vehicles {
                format!("the {} with a line of their own", class.vehicles.len())
            } else {
                "them".to_owned()
            };
            let message = message
                .text(format!(", fitted to {count} tests of {vehicles} vehicles, with the spread between {those} as far as they tell"));
            match self.is_uncertain && class.is_far_from(&self.fit) {
                true => Notice::warning("stiffness-from-tests", key, message.text("; it is ").join(class.contradiction())),
                false => Notice::note("stiffness-from-tests", key, message),
            }
        } else if vehicles > 1 {
            let message = message.text(format!(
                ", fitted to {count} tests of {vehicles} vehicles, without the spread between them, which takes two with tests to different depths or an onset: it \
                 is less certain"
            ));
            Notice::warning("stiffness-from-tests", key, message)
        } else if self.fit.is_poor() {
            let (chi_square, freedom) = (self.fit.chi_square, degrees_of_freedom(self.fit.degrees_of_freedom));
            let message = message.text(format!(
                ", fitted to {count} tests, which differ by more than their standard deviations allow (chi-square {chi_square:.1} with {freedom}): \
                 its own are {:.1} times those of the fit, as the residuals tell",
                self.enlarged.unwrap_or(1.0)
            ));
            Notice::warning("stiffness-from-tests", key, message)
        } else if !self.is_uncertain {
            let message = message.text(", fitted to two tests, which do not tell how far off they are: it counts as certain");
            Notice::warning("stiffness-from-tests", key, message)
        } else if let Some(factor) = self.enlarged {
            let message = message.text(format!(
                ", fitted to {count} tests, of which the residuals alone tell how far off they are: the standard deviations are {factor:.1} times those of the fit, \
                 so that 95 % intervals are those of Student's distribution; give those of the tests"
            ));
            Notice::note("stiffness-from-tests", key, message)
        } else {
            Notice::note("stiffness-from-tests", key, message.text(format!(", fitted to {count} tests")))
        }
    }
}

/// Reports what is wrong with a file at the key that names it.
pub(crate) fn report(place: &Field<'_>, issues: &Issues) {
    for issue in issues.list() {
        let at = match issues.line(issue) {
            Some(line) => format!("{}:{line}: ", issues.source().name),
            None => String::new(),
        };
        let path = if issue.path.is_empty() { String::new() } else { format!("{}: ", issue.path) };
        let help = issue.help.as_ref().map(|help| Units::Si.sentence(help));
        place.report(format!("{at}{path}{}", Units::Si.sentence(&issue.message)), help);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use planar_impact::Side;

    use crate::case::{Case, CrushKey};

    /// A case of two vehicles whose stiffness is fitted to the tests of `count` vehicles, each of them known almost exactly.
    fn case(count: usize) -> Case {
        let depth = |d0: f64, d1: f64, depth: f64| {
            let speed = ((d0 + d1 * depth).powi(2) * 1.5 / 1500.0).sqrt();
            format!(
                "[[vehicle.test]]\nmass = 1500\nspeed = {speed}\nrestitution = 0\nwidth = 1.5\ndepths = [{depth}, {depth}]\nscatter = 0.01\n"
            )
        };
        let of_class = |i: usize| {
            let (d0, d1) = (90.0 + 10.0 * i as f64, 700.0 + 30.0 * ((i * i) % 5) as f64);
            let tests: String = [0.1, 0.4].map(|at| depth(d0, d1, at)).concat();
            format!("[[vehicle]]\nname = \"{i}\"\nnew_cars = true\n{tests}")
        };
        let tests: String = "schema = 1\n".to_owned() + &(0..count).map(of_class).collect::<String>();
        let vehicle = |heading: f64| {
            format!(
                "[[vehicle]]\nmass = 1000\nyaw_inertia = 1500\nheading = {heading}\nspeed = 10\nimpact_center = [2, 0]\n\
                 crush = {{ width = 1.5, depths = [0.2, 0.3], stiffness = {{ tests = \"tests.toml\" }} }}\n"
            )
        };
        let text = format!("schema = 1\n{}{}[contact]\ncrush_plane = 0\nrestitution = 0\n", vehicle(0.0), vehicle(3.1));
        let open = move |name: &str| Ok(Source::new(name, tests.clone()));
        Case::parse_with(Source::new("case.toml", text), Box::new(open)).unwrap_or_else(|issues| panic!("{issues}"))
    }

    /// The mean of k vehicles that are known exactly has 1/k of the variance of one, which a further one has in addition: two further ones share 1/(k + 1).
    #[test]
    fn two_vehicles_of_a_class_share_its_mean() {
        for count in [2, 3, 6] {
            let case = case(count);
            for of in [CrushKey::Onset, CrushKey::Slope] {
                let [one, two] = Side::ALL.map(|side| Parameter::Crush(side, of));
                let shared = case.uncertain.correlation(one, two);
                assert!((shared * (count + 1) as f64 - 1.0).abs() < 1e-3, "{count}: {shared}");
            }
        }
    }
}
