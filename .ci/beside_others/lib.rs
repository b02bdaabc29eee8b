//! Each item of the interface for embedding, beside glob imports of other crates.

#![deny(warnings)]
#![allow(unused_imports)]

#[cfg(test)]
mod tests {
    use approx::*;
    use nalgebra::*;
    use num_dual::*;
    use num_traits::*;
    use planar_impact::prelude::*;

    fn car() -> Vehicle {
        Vehicle::new(1200.0, 1900.0).with_impact_center(1.8, 0.3).with_speed(15.0)
    }

    fn collision() -> Collision {
        Collision::new(car(), Party::Barrier).with_crush_plane(CrushPlane::from_degrees(5.0)).with_restitution(0.1)
    }

    /// The square root of a dual number is num-dual's: at zero its derivative is not a number.
    #[test]
    fn methods_of_other_crates_stay_theirs() {
        assert!(Dual64::new(0.0, 1.0).sqrt().eps.is_infinite() || Dual64::new(0.0, 1.0).sqrt().eps.is_nan());
        assert_eq!(Float::sqrt(4.0), 2.0);
        assert_eq!(2_f64.sin_cos(), (2_f64.sin(), 2_f64.cos()));
        assert_eq!(Vector2::new(3.0, 4.0).magnitude(), 5.0);
    }

    #[test]
    fn vectors_go_to_and_fro() {
        let v = Xy::from(Vector2::new(1.0, 2.0));
        assert_eq!(Vector2::from(2.0 * v / 4.0 + v), Vector2::new(1.5, 3.0));
        assert_eq!(mint::Vector2::from(Nt::from([1.0, 2.0])), mint::Vector2 { x: 1.0, y: 2.0 });
        assert_eq!([v, v].iter().sum::<Xy>(), Xy::from((2.0, 4.0)));
        let mut w = ForwardLeft::new(1.0, 2.0);
        w += w;
        assert_eq!(<[f64; 2]>::from(w), [2.0, 4.0]);
    }

    #[test]
    fn derivatives_count_in_comparisons() {
        let dual = |eps| Xy::new(Dual64::new(1.0, eps), Dual64::new(2.0, 0.0));
        assert_abs_diff_eq!(dual(1.0), dual(1.0 + 1e-12), epsilon = 1e-9);
        assert_abs_diff_ne!(dual(1.0), dual(1.5), epsilon = 1e-9);
        let sensitivities = collision().sensitivities().expect("it closes");
        assert_relative_eq!(sensitivities, sensitivities);
    }

    #[test]
    fn names_are_parsed_sorted_and_hashed() {
        assert_eq!("m1".parse(), Ok(Input::Mass(Side::One)));
        assert_eq!("energy.loss".parse(), Ok(Output::Loss));
        assert!("m3".parse::<Input>().is_err());
        let all: std::collections::HashSet<_> = Output::ALL.into_iter().collect();
        let sorted: std::collections::BTreeSet<_> = Input::ALL.into_iter().collect();
        assert_eq!((all.len(), sorted.len(), Side::One.other()), (Output::COUNT, Input::COUNT, Side::ALL[1]));
    }

    #[test]
    fn what_a_user_stores_comes_back() {
        let collision = collision().with_impulse_ratio(ImpulseRatio::LimitedByFriction(0.4)).with_moment(Moment::Given(2.0));
        let text = serde_json::to_string(&collision).expect("plain data");
        assert_eq!(serde_json::from_str::<Collision>(&text).expect("as written"), collision);
        let impact = collision.solve().expect("it closes");
        assert_eq!(serde_json::from_str::<Impact>(&serde_json::to_string(&impact).expect("plain data")).expect("as written"), impact);
        assert_eq!(serde_json::to_string(&Input::CrushPlane).expect("a name"), "\"contact.crush_plane\"");
        assert_eq!(serde_json::from_str::<Output>("\"W_n\"").expect("a symbol"), Output::NormalWork);
    }

    /// A value, its JSON, and the value that is read from that.
    fn stored<T: serde::Serialize + serde::de::DeserializeOwned>(value: &T) -> (String, T) {
        let text = serde_json::to_string(value).expect("plain data");
        let read = serde_json::from_str(&text).expect("as written");
        (text, read)
    }

    #[test]
    fn records_of_the_checker_come_back_by_name() {
        use planar_impact::check::{Key, Options, Outcome, Profile, RatioKind, Record, Resolution, ResolutionGroup, Rule, check};
        let collision = collision();
        let record = Record {
            id: "one".into(),
            resolution: Resolution::default().with(ResolutionGroup::Velocity, 0.5).with_key(Key::Mass(Side::One), 10.0),
            ..Record::of(&collision, &collision.solve().expect("it closes"))
        };
        let (text, read) = stored(&record);
        assert_eq!(read, record);
        assert!(text.contains(r#"{"groups":[["v",0.5]],"keys":[["b1.mass",10.0]]}"#), "{text}");
        for rule in Rule::ALL {
            assert_eq!(stored(&rule), (format!("{:?}", rule.name()), rule));
        }
        for group in ResolutionGroup::ALL {
            assert_eq!(stored(&group), (format!("{:?}", group.name()), group));
        }
        for profile in Profile::ALL {
            assert_eq!(stored(&profile), (format!("{:?}", profile.name()), profile));
        }
        for kind in RatioKind::ALL {
            assert_eq!(stored(&kind), (format!("{:?}", kind.name()), kind));
        }
        let outcome: Outcome = check(&Record { id: "empty".into(), ..Record::default() }, &Options::default());
        assert!(serde_json::to_string(&outcome).expect("plain data").starts_with(r#"{"id":"empty","findings":["#));
    }

    #[test]
    fn profiles_and_tests_are_checked_where_they_are_read() {
        use planar_impact::barrier::{BarrierTest, Record, TestSeries};
        use planar_impact::crush::{Profile, ProfileMoments, StiffnessZones};
        for profile in [Profile::equally_spaced(1.5, vec![0.1, 0.3]), Profile::at_stations(vec![0.0, 0.5, 1.5], vec![0.1, 0.3, 0.2])] {
            let profile = profile.expect("valid");
            assert_eq!(stored(&profile).1, profile);
        }
        let test =
            BarrierTest { mass: 1500.0, speed: 15.0, restitution: 0.1, crush: ProfileMoments::of(1.5, &[0.3, 0.3]).expect("two depths") };
        let series = TestSeries::new([test]).expect("valid");
        assert_eq!(stored(&series).1, series);
        let record = Record::uniform(0.0, 0.001, vec![0.0, 1.0]).expect("valid");
        assert_eq!(stored(&record).1, record);
        let refused =
            serde_json::from_str::<Profile>(r#"{"stations":{"Equal":{"width":-1.5}},"depths":[0.1,0.3]}"#).expect_err("a negative width");
        assert!(refused.to_string().contains("width"), "{refused}");
        assert!(serde_json::from_str::<TestSeries>("[]").is_err());
        assert!(serde_json::from_str::<Record>(r#"{"clock":{"Given":[1.0,0.0]},"values":[0.0,1.0]}"#).is_err());
        assert!(serde_json::from_str::<StiffnessZones>(r#"{"zones":[],"borders":[]}"#).is_err());
    }

    #[test]
    fn refusals_are_data() {
        let refusals = Collision::new(Vehicle::new(-1.0, 2500.0), Party::Barrier).solve().expect_err("a negative mass");
        let data = serde_json::to_value(&refusals).expect("plain data");
        assert_eq!(data[0]["Input"]["at"]["name"], "vehicle.1.mass");
        assert_eq!(data[0]["Input"]["kind"]["NotPositive"]["value"], -1.0);
    }

    #[test]
    fn a_planner_gets_and_sets_inputs_and_pulls_back() {
        let mut collision = collision();
        collision.set(Input::Restitution, 0.2).expect("every collision has it");
        assert!(collision.set(Input::ImpulseRatio, 0.2).is_err());
        let again = collision.with_inputs(collision.to_inputs()).solve().expect("it closes");
        // An angle is converted to a direction and back.
        assert_relative_eq!(again, collision.solve().expect("as before"), epsilon = 1e-9, max_relative = 1e-12);
        let weights = Outputs { loss: 1.0, ..Outputs::default() };
        let by = collision.pullback(&weights).expect("it closes");
        assert_relative_eq!(by, collision.sensitivity(Output::Loss).expect("it closes").by, max_relative = 1e-12);
        let mut direction = [0.0; Input::COUNT];
        direction[Input::Restitution.index()] = 1.0;
        let along = collision.pushforward(&direction).expect("it closes");
        assert_relative_eq!(along.loss, by[Input::Restitution], max_relative = 1e-12);
    }

    #[test]
    fn refusals_have_codes_and_all_come_at_once() {
        let refusals = Collision::new(Vehicle::new(-1.0, f64::NAN), Party::Barrier).solve().expect_err("two numbers are wrong");
        let codes: Vec<_> = refusals.iter().map(|refusal| refusal.code()).collect();
        assert_eq!(codes, ["not-positive", "not-finite"]);
        for refusal in refusals {
            assert!(!refusal.to_string().is_empty());
        }
    }

    #[test]
    fn text_and_quantities() {
        use planar_impact::uom::si::{angle::degree, f64::Angle};
        let heading = Heading::from(Angle::new::<degree>(180.0));
        assert_abs_diff_eq!(heading, Heading::from_degrees(0.0).reversed(), epsilon = 1e-15);
        let impact = collision().solve().expect("it closes");
        assert!(format!("{impact}").contains("m/s") && format!("{}", car()).contains("kg"));
    }
}

/// Everything of the root, and of its modules, beside everything of the others: no two imports fight.
pub mod everything {
    use approx::*;
    use nalgebra::*;
    use num_dual::*;
    use num_traits::*;
    use planar_impact::barrier::*;
    use planar_impact::check::*;
    use planar_impact::crash3::*;
    use planar_impact::crush::*;
    use planar_impact::reconstruct::*;
    use planar_impact::*;

    /// A square root of num-dual's.
    pub fn root(x: Dual64) -> Dual64 {
        x.sqrt()
    }
}
