//! Instrumented barrier tests: stiffness, impulse and restitution from measurements of a vehicle's impact with a fixed barrier.
//!
//! # Steps, file by file
//!
//! | known | result | item |
//! |---|---|---|
//! | mass, normal speed, restitution and crush of one test, and an assumed onset | its crush energy ½ m (1 − e²) v_n²; d₀ and d₁ | [`BarrierTest`] |
//! | repeated tests of one vehicle | the energies add up: EES = √Σ (1 − e²) v_n² (Eq 9) | [`TestSeries`] |
//! | several tests with their standard deviations | E* = √(2 E_C/w) of each, and the covariance of these | [`Observations`] |
//! | E* of several crushes | d₀ and d₁ with covariance and residuals, and the resulting uncertainty of E_C | [`StiffnessFit`] |
//! | the stiffness of several vehicles of a class | its mean and its spread between them | [`RandomEffects`] |
//! | forces over time | baseline, filter of a channel frequency class, impulse with its variance | [`Record`], [`ChannelFilter`] |
//! | a record that a channel could not hold | its resolution, and where it was driven beyond its range | [`Record::resolution`], [`Record::flat_top`] |
//! | the load cells of a barrier | banks, normal and tangential impulse, μ = P_t/P_n (A8) | [`BarrierRecord`], [`bank`], [`impulse_ratio`] |
//! | the motion at contact and at separation | e = −V_Cn/v_Cn of a point, by rigid-body kinematics (A7) | [`MeasuredContact`] |
//! | the distance of a point from the barrier over time | e by the slope of the smoothed distance, with its variance | [`Lowess`], [`restitution_from_film`] |
//!
//! # Stiffness from tests
//!
//! Restitution enters as 1 − e²: the rebound returns e² of the energy, and the rest stays in the crush. One test and an assumed onset allow two answers.
//! [`BarrierTest::speed_line`] is the customary one, which uses the mean crush depth; published A and B are computed this way. [`BarrierTest::stiffness`]
//! reproduces the energy of the test exactly from the measured profile. Several tests allow the same two: [`StiffnessFit::on_mean_depth`] is the line of the
//! paper's Figure 7, in closed form, and [`StiffnessFit::on_profiles`] is Eq 4 itself.
//!
//! The Struble–Welsh series of the paper, three tests on one car:
//!
//! ```
//! use planar_impact::barrier::{BarrierTest, MeasuredTest, Observations, StiffnessFit};
//! use planar_impact::crush::ProfileMoments;
//! // Tables B1 and B2, in ft, slug, s and lbf; 0.3 ft/s and 0.05 are taken for the standard deviations.
//! let test = |speed, restitution, depth| {
//!     let crush = ProfileMoments::of(5.0, &[depth, depth]).unwrap();
//!     let test = BarrierTest { mass: 101.91, speed, restitution, crush };
//!     MeasuredTest { test, speed_deviation: 0.3, restitution_deviation: 0.05, scatter: 5.0 }
//! };
//! let series = [test(16.6537, 0.18, 0.1062), test(29.3669, 0.13, 0.5203), test(36.858, 0.12, 1.0768)];
//! let fit = StiffnessFit::on_mean_depth(&Observations::of_tests(&[series])?)?;
//! // The pair of Table B2, from NHTSA's tests, is 48.27 √lbf and 162.8 √lbf/ft: this car takes more energy at first, by 2.7 standard
//! // deviations; its slope does not differ significantly, by 1.3.
//! assert_eq!(format!("{:.1} ± {:.1}", fit.stiffness.onset, fit.onset().deviation()), "62.7 ± 5.3");
//! assert_eq!(format!("{:.1} ± {:.1}", fit.stiffness.slope, fit.slope().deviation()), "152.8 ± 7.5");
//! // Its energy at a depth of 1 ft, in ft lb.
//! let energy = fit.energy_at(1.0, 5.0);
//! assert_eq!(format!("{:.0} ± {:.0}", energy.value, energy.deviation()), "116062 ± 4903");
//! # Ok::<(), planar_impact::barrier::TestIssues>(())
//! ```
//!
//! A speed b₀ that leaves no crush may be known from elsewhere: [`StiffnessFit::with_onset`] holds d₀ = b₀ √(m/w) and fits d₁ alone, for which one test is enough.
//! So may the force A at which crush begins: [`StiffnessFit::with_force`] holds d₀ d₁ = A.
//!
//! # No corrections
//!
//! Nothing is clamped, reordered or left out. A negative d₀ is returned as it is, and [`StiffnessFit::findings`] reports it; a restitution outside 0 to 1 is
//! returned from film data as it is, and refused as the input of a test. Every invalid input is an error with its name, place and number, and all of them are
//! returned at once ([`TestIssues`]).
//!
//! # Properties
//!
//! | property | test in `proptests/` |
//! |---|---|
//! | exact data reproduce the stiffness exactly, whatever the weights | `barrier.rs`, `exact_data_give_back_the_stiffness`, `exact_profiles_give_back_the_stiffness` |
//! | one test's stiffness reproduces the energy of the test, and the customary line gives more | `barrier.rs`, `one_test_has_its_energy` |
//! | the covariance covers noisy data at the stated rate: as given, from the residuals, and for repeated tests | `barrier.rs`, `the_covariance_covers_at_its_rate`, `the_covariance_of_repeated_tests_covers_at_its_rate` |
//! | with zero duration, kinematics reproduce the restitution of any impact | `barrier.rs`, `kinematics_give_back_the_restitution` |
//! | impulses of closed-form pulses, with offset and noise, are found within the bound set by the noise | `records.rs`, `impulses_of_known_pulses` |
//! | the filter is linear, preserves constants and impulses, and delays nothing | `records.rs`, `the_filter_is_linear`, `the_filter_keeps_the_impulse`, `the_filter_is_symmetric` |
//! | LOWESS is exact on straight lines for any span | `records.rs`, `lowess_keeps_straight_lines` |
//! | the variance of its slope covers noisy lines at the stated rate | `records.rs`, `the_slope_covers_at_its_rate` |
//! | derivatives from dual numbers match difference quotients | both, `derivatives…` |

mod bank;
mod estimate;
mod film;
mod filter;
mod fit;
mod fitted;
mod held_force;
mod issue;
mod kinematics;
mod line_fit;
mod lowess;
mod noise;
mod observation;
mod pooled;
mod profile_fit;
mod record;
mod sampling;
mod series;
mod soundness;
mod test;
mod weight;

pub use bank::{BarrierRecord, bank, impulse_ratio};
pub use estimate::Estimate;
pub use film::{restitution_from_film, restitution_from_smoothed};
pub use filter::{ChannelClass, ChannelFilter};
pub use fit::{CovarianceBasis, CrushModel, FitFinding, StiffnessFit};
pub use fitted::{Residual, StiffnessCovariance};
pub use issue::{TestIssue, TestIssues};
pub use kinematics::{MeasuredContact, PointOfVehicle, heading_at_separation, restitution};
pub use lowess::{LocalLine, Lowess, Smoothed};
pub use observation::{CrushEnergy, MeasuredTest, Observation, Observations};
pub use pooled::RandomEffects;
pub use record::{Clock, Record, Window};
pub use series::TestSeries;
pub use soundness::FlatTop;
pub use test::BarrierTest;
