//! Tests of every unit against exact references, and of every refusal.

use super::*;

/// Values and their conversions by Python's fractions, with π and the root of the pound-force to 60 digits, rounded once.
#[rustfmt::skip]
const CONVERSIONS: &[(Kind, &str, f64)] = &[
    (Kind::MASS, "2564 lb", 1163.01083668),
    (Kind::MASS, "2564 lbs", 1163.01083668),
    (Kind::MASS, "3.5 lbm", 1.587573295),
    (Kind::MASS, "1500 kg", 1500.0),
    (Kind::MASS, "250 g", 0.25),
    (Kind::MASS, "7000 mg", 0.007),
    (Kind::MASS, "1.3 t", 1300.0),
    (Kind::MASS, "79.7 slug", 1163.1340640953472),
    (Kind::MASS, "2564 pounds", 1163.01083668),
    (Kind::MASS, "2564 Lbs", 1163.01083668),
    (Kind::MASS, "1.3 tonne", 1300.0),
    (Kind::MASS, "79.7 slugs", 1163.1340640953472),
    (Kind::LENGTH, "5.47 m", 5.47),
    (Kind::LENGTH, "5.47 metres", 5.47),
    (Kind::LENGTH, "5.47 feet", 1.667256),
    (Kind::LENGTH, "33.3 inches", 0.84582),
    (Kind::LENGTH, "12.3 cm", 0.123),
    (Kind::LENGTH, "12.3 mm", 0.0123),
    (Kind::LENGTH, "12.3 dm", 1.23),
    (Kind::LENGTH, "123 \u{b5}m", 0.000123),
    (Kind::LENGTH, "0.7 km", 700.0),
    (Kind::LENGTH, "33.3 in", 0.84582),
    (Kind::LENGTH, "5.47 ft", 1.667256),
    (Kind::LENGTH, "1.1 yd", 1.00584),
    (Kind::LENGTH, "0.3 mi", 482.8032),
    (Kind::DURATION, "0.3 s", 0.3),
    (Kind::DURATION, "0.3 sec", 0.3),
    (Kind::DURATION, "100 ms", 0.1),
    (Kind::DURATION, "1.7 min", 102.0),
    (Kind::DURATION, "0.1 h", 360.0),
    (Kind::SPEED, "13.7 m/s", 13.7),
    (Kind::SPEED, "50 km/h", 13.88888888888889),
    (Kind::SPEED, "50 kph", 13.88888888888889),
    (Kind::SPEED, "50 kmh", 13.88888888888889),
    (Kind::SPEED, "50 km/hr", 13.88888888888889),
    (Kind::SPEED, "35 mph", 15.6464),
    (Kind::SPEED, "35 MPH", 15.6464),
    (Kind::SPEED, "40 ft/s", 12.192),
    (Kind::SPEED, "40ft/s", 12.192),
    (Kind::SPEED, "40 fps", 12.192),
    (Kind::SPEED, "3.3 kn", 1.6976666666666667),
    (Kind::SPEED, "3.3 mi/h", 1.475232),
    (Kind::SPEED, "7 in/ms", 177.8),
    (Kind::ANGLE, "-10 deg", -0.17453292519943295),
    (Kind::ANGLE, "40°", 0.6981317007977318),
    (Kind::ANGLE, "40 degrees", 0.6981317007977318),
    (Kind::ANGLE, "1.5 rad", 1.5),
    (Kind::ANGLE, "100 gon", std::f64::consts::FRAC_PI_2),
    (Kind::ANGLE, "0.3 rev", 1.8849555921538759),
    (Kind::YAW_RATE, "33.3 deg/s", 0.5811946409141118),
    (Kind::YAW_RATE, "1.1 rad/s", 1.1),
    (Kind::YAW_RATE, "3.7 rev/min", 0.38746309394274114),
    (Kind::YAW_RATE, "3.7 rpm", 0.38746309394274114),
    (Kind::YAW_RATE, "17 °/s", 0.29670597283903605),
    (Kind::ACCELERATION, "0.7 g0", 6.864655),
    (Kind::ACCELERATION, "32.2 ft/s^2", 9.81456),
    (Kind::FORCE, "3.3 N", 3.3),
    (Kind::FORCE, "3.3 kN", 3300.0),
    (Kind::FORCE, "3.3 MN", 3_300_000.0),
    (Kind::FORCE, "3.3 lbf", 14.67913133035965),
    (Kind::FORCE, "3.3 lb", 14.67913133035965),
    (Kind::FORCE, "3.3 kip", 14679.13133035965),
    (Kind::IMPULSE, "5000 N s", 5000.0),
    (Kind::IMPULSE, "1234.5 lbf s", 5491.329584039087),
    (Kind::ENERGY, "3.3 J", 3.3),
    (Kind::ENERGY, "3.3 kJ", 3300.0),
    (Kind::ENERGY, "54321 ft lb", 73649.38677131),
    (Kind::ENERGY, "54321 ft·lb", 73649.38677131),
    (Kind::ENERGY, "54321 ft-lb", 73649.38677131),
    (Kind::ENERGY, "54321 ft lbf", 73649.38677131),
    (Kind::ENERGY, "7 N m", 7.0),
    (Kind::YAW_INERTIA, "2000 kg m^2", 2000.0),
    (Kind::YAW_INERTIA, "1434.9 lbf s^2 ft", 1945.4631740607265),
    (Kind::YAW_INERTIA, "1434.9 lb ft s^2", 1945.4631740607265),
    (Kind::YAW_INERTIA, "1434.9 lb-sec^2-ft", 1945.4631740607265),
    (Kind::YAW_INERTIA, "1434.9 lbf s^2 in", 162.1219311717272),
    (Kind::YAW_INERTIA, "1434.9 slug ft^2", 1945.4631740607265),
    (Kind::YAW_INERTIA, "1434.9 slug·ft²", 1945.4631740607265),
    (Kind::YAW_INERTIA, "46200 lb ft^2", 1946.8730863337817),
    (Kind::STIFFNESS, "3.3 N/m", 3.3),
    (Kind::STIFFNESS, "3.3 N/cm", 330.0),
    (Kind::STIFFNESS, "317 lbf/in", 55515.20677313301),
    (Kind::STIFFNESS, "317 lb/in", 55515.20677313301),
    (Kind::STIFFNESS, "3.3 kN/mm", 3300000.0),
    (Kind::STIFFNESS_PER_WIDTH, "3.3 N/m^2", 3.3),
    (Kind::STIFFNESS_PER_WIDTH, "3.3 Pa", 3.3),
    (Kind::STIFFNESS_PER_WIDTH, "3.3 kPa", 3300.0),
    (Kind::STIFFNESS_PER_WIDTH, "3.3 MPa", 3300000.0),
    (Kind::STIFFNESS_PER_WIDTH, "57 lbf/in^2", 393001.1657105966),
    (Kind::STIFFNESS_PER_WIDTH, "57 lbf/in/in", 393001.1657105966),
    (Kind::STIFFNESS_PER_WIDTH, "57 psi", 393001.1657105966),
    (Kind::STIFFNESS_PER_WIDTH, "57 lb/in^2", 393001.1657105966),
    (Kind::ROOT_FORCE, "91.3 lbf^0.5", 192.55907258841583),
    (Kind::ROOT_FORCE, "91.3 lb^0.5", 192.55907258841583),
    (Kind::ROOT_FORCE, "91.3 N^0.5", 91.3),
    (Kind::ROOT_FORCE_PER_LENGTH, "162.8 lbf^0.5/ft", 1126.5037608341058),
    (Kind::ROOT_FORCE_PER_LENGTH, "9.1 lbf^0.5/in", 755.6155447363903),
    (Kind::PURE, "0.3", 0.3),
    (Kind::PURE, "15 %", 0.15),
    (Kind::PURE, "15%", 0.15),
];

fn si(text: &str, kind: Kind) -> Result<f64, String> {
    parse(text, kind).map(|read| read.si).map_err(|error| error.to_string())
}

fn error(text: &str, kind: Kind) -> String {
    si(text, kind).unwrap_err()
}

#[test]
fn conversions_are_within_one_unit_in_the_last_place() {
    for (kind, text, exact) in CONVERSIONS {
        let read = si(text, *kind).unwrap();
        let distance = read.to_bits().abs_diff(exact.to_bits());
        assert!(distance <= 1, "{text}: {read:?}, not {exact:?}");
        let unit = parse(text, *kind).unwrap().unit;
        if !unit.is_empty() && !text.contains("lb") {
            let back = Conversion::to(&unit).of_si(read);
            assert!((back - number::split(text).unwrap().0).abs() <= 2.0 * f64::EPSILON * back.abs());
        }
    }
}

#[test]
fn printing_units() {
    let ulp = |got: f64, exact: f64| assert!(got.to_bits().abs_diff(exact.to_bits()) <= 1, "{got} {exact}");
    assert_eq!(Conversion::to("ft/s").of_si(0.3048), 1.0); // 1 ft
    assert_eq!(Conversion::to("mph").of_si(0.447_04), 1.0); // 1609.344/3600
    ulp(Conversion::to("deg").of_si(std::f64::consts::PI), 180.0);
    ulp(Conversion::to("ft lbf").of_si(1.0), 0.737_562_149_277_265_5); // 1/(0.3048*4.4482216152605)
    ulp(Conversion::to("lbf s").of_si(4.448_221_615_260_5), 1.0);
    ulp(Conversion::to("deg/s").of_si(1.0), 57.295_779_513_082_32); // 180/π
    assert_eq!(Conversion::to("kJ").of_si(1234.0), 1.234);
    assert_eq!(Conversion::to("km/h").of_si(10.0), 36.0);
    assert!(Conversion::to("furlong").of_si(1.0).is_nan());
}

#[test]
fn the_unit_as_written_is_kept() {
    let written = parse("  40ft/s ", Kind::SPEED).unwrap();
    assert_eq!((written.unit.as_str(), written.bare), ("ft/s", false));
    let bare = bare("13", 13.0, Kind::SPEED).unwrap();
    assert_eq!((bare.si, bare.unit.as_str(), bare.bare), (13.0, "m/s", true));
}

#[test]
fn another_dimension_is_refused() {
    assert_eq!(error("40 ft", Kind::SPEED), "`40 ft` is a length; a speed is expected, such as \"40 ft/s\"");
    assert_eq!(error("40 deg/s", Kind::SPEED), "`40 deg/s` is a yaw rate; a speed is expected, such as \"40 ft/s\"");
    assert_eq!(
        error("3 s^-1", Kind::YAW_RATE), // strict: an angle per time, not 1/s
        "`3 s^-1` is a speed per length; a yaw rate is expected, such as \"30 deg/s\" (write rad/s, deg/s or rpm)"
    );
    assert_eq!(
        error("54321 ft lb", Kind::YAW_INERTIA), // a mass times a length
        "`54321 ft lb` is in kg m; a yaw inertia is expected, such as \"2000 kg m^2\""
    );
    let gravity = error("1 g", Kind::ACCELERATION);
    assert!(
        gravity.starts_with("`1 g` is a mass; an acceleration is expected")
            && gravity.ends_with("(`g` is the gram; write `g0` for the standard acceleration of gravity)"),
        "{gravity}"
    );
    assert_eq!(error("3 kg", Kind::PURE), "`3 kg` is a mass; a pure number is expected, such as \"0.3\"");
    assert!(error("5 kn", Kind::FORCE).contains("is a speed")); // a knot, not a kilonewton
}

#[test]
fn a_pound_is_a_force_where_only_that_fits() {
    let forced = |text: &str, kind| parse(text, kind).map(|read| read.pound_force);
    for (text, kind) in [("300 lb/in", Kind::STIFFNESS), ("12 lb ft s^2", Kind::YAW_INERTIA), ("2564 lbs", Kind::FORCE)] {
        assert_eq!(forced(text, kind), Ok(true), "{text}");
        let [value, deviation] = parse_pair(text, "7", kind).expect("a pair");
        assert!(value.pound_force && deviation.pound_force);
    }
    // As written, or a foot-pound of energy.
    for (text, kind) in
        [("300 lbf/in", Kind::STIFFNESS), ("46200 lb ft^2", Kind::YAW_INERTIA), ("2564 lb", Kind::MASS), ("9 ft lb", Kind::ENERGY)]
    {
        assert_eq!(forced(text, kind), Ok(false), "{text}");
    }
    assert_eq!(error("300 lb/in", Kind::STIFFNESS_PER_WIDTH).split(';').next(), Some("`300 lb/in` is in kg m^-1")); // right as neither
    assert_eq!(error("12 lb ft", Kind::YAW_INERTIA).split(';').next(), Some("`12 lb ft` is in kg m"));
}

#[test]
fn a_range_is_told_as_one() {
    for (text, kind, least, greatest) in [
        ("40-45 mph", Kind::SPEED, "40 mph", "45 mph"),
        ("40 mph – 45 mph", Kind::SPEED, "40 mph", "45 mph"),
        ("40mph to 70 km/h", Kind::SPEED, "40mph", "70 km/h"),
        ("-10 - -5 deg", Kind::ANGLE, "-10 deg", "-5 deg"),
        ("0.1..0.2", Kind::PURE, "0.1", "0.2"),
        ("10-20 %", Kind::PURE, "10 %", "20 %"),
        ("5 ft - 5 ft 2 in", Kind::LENGTH, "5 ft", "5 ft 2 in"),
    ] {
        let error = parse(text, kind).expect_err(text);
        assert!(error.message.ends_with("is a range, and not one number"), "{text}: {error}");
        let help = format!("where an input may be uncertain, write {{ min = \"{least}\", max = \"{greatest}\" }}");
        assert_eq!(error.help, Some(help), "{text}");
    }
    // Nor is what would take long to read as one.
    let hostile = format!("{}2 mph", "1 - ".repeat(100_000));
    assert!(!parse(&hostile, Kind::SPEED).expect_err("no quantity").message.contains("range"));
    // From the greater to the lesser is no range, nor is an exponent or a unit with a sign.
    for (text, kind) in [("45-40 mph", Kind::SPEED), ("40 m s-1x", Kind::SPEED), ("1e-x m", Kind::LENGTH), ("40 - mph", Kind::SPEED)] {
        assert!(!parse(text, kind).expect_err(text).message.contains("range"), "{text}");
    }
    assert!(parse("40 m s^-1", Kind::SPEED).is_ok() && parse("1e-1 m", Kind::LENGTH).is_ok());
}

#[test]
fn a_string_needs_a_unit() {
    assert_eq!(
        error("40", Kind::SPEED),
        "\"40\" has no unit; expected a speed, such as \"40 ft/s\" \
         (a string needs a unit; a number without quotes is in m/s)"
    );
    assert_eq!(error(" ", Kind::MASS), "the string is empty; expected a mass, such as \"1500 kg\"");
    assert_eq!(error("1 2000 kg", Kind::MASS), "unknown unit `2000`");
    assert_eq!(error("40 mhp", Kind::SPEED), "unknown unit `mhp` (did you mean `mph`?)");
    assert_eq!(error("3 rads", Kind::ANGLE), "unknown unit `rads` (did you mean `rad`?)");
    assert_eq!(error("3 lbfs", Kind::IMPULSE), "unknown unit `lbfs` (did you mean `lbf s`?)");
    for (unit, meant) in [
        ("mps", "`m/s`"),
        ("fpm", "`ft/min`"),
        ("kts", "`kn`"),
        ("stone", "`lb` or `kg`"),
        ("Tons", "`lb`, `kg` or `tonne`"),
        ("grads", "`gon` or `deg`"),
    ] {
        let said = error(&format!("40 {unit}"), Kind::SPEED);
        assert!(said.starts_with(&format!("unknown unit `{unit}` (")) && said.ends_with(&format!("write {meant})")), "{said}");
    }
}

#[test]
fn domains() {
    assert_eq!(si("0 lb", Kind::MASS), Ok(0.0)); // refused by the library
    assert_eq!(si("-5 kg", Kind::MASS), Ok(-5.0));
    assert_eq!(error("1e12 t", Kind::MASS), "`1e12 t` is too large for a mass");
    assert_eq!(error("1 mg", Kind::MASS), "`1 mg` is too small for a mass");
    assert_eq!(si("1000 m", Kind::LENGTH), Ok(1000.0));
    for unit in ["m/h", "m/hr", "m/hrs", "m/hour", "meters/hour", "m h^-1"] {
        assert!(
            error(&format!("40 {unit}"), Kind::SPEED).contains("in meters per hour, as no vehicle is (write `mph` or `km/h`)"),
            "{unit}"
        );
    }
    assert!(si("40 km/hr", Kind::SPEED).is_ok() && si("40 m/min", Kind::SPEED).is_ok());
    assert!(error("1.001 km", Kind::LENGTH).starts_with("`1.001 km` is too large for a length (if it is a coordinate of a map"));
    assert!(error("1e308 km", Kind::LENGTH).starts_with("`1e308 km` is too large for a length"));
    assert_eq!(error("4500 km/s", Kind::SPEED), "`4500 km/s` is too large for a speed");
    assert_eq!(error("1e-323 mm", Kind::LENGTH), "`1e-323 mm` is too small for a length");
    assert!(si("1e6 deg", Kind::ANGLE).is_ok() && si("1.1e6 deg", Kind::ANGLE).is_err());
    assert!(si("-1e5 m/s", Kind::SPEED).is_ok() && si("-1.1e5 m/s", Kind::SPEED).is_err());
    assert!(si("1e4 rad/s", Kind::YAW_RATE).is_ok() && si("2e4 rad/s", Kind::YAW_RATE).is_err());
    assert!(si("1e15 kg m^2", Kind::YAW_INERTIA).is_ok() && si("1e-10 kg m^2", Kind::YAW_INERTIA).is_err());
}

#[test]
fn bare_numbers_are_in_si_and_plausible() {
    let refusal = |value: f64, kind| bare(&value.to_string(), value, kind).unwrap_err().to_string();
    assert_eq!(
        refusal(180.0, Kind::ANGLE), // 180/2π = 28.648
        "a number without a unit is taken in rad, and 180 rad is 28.6 turns \
         (did you mean \"180 deg\"? If not, write \"180 rad\")"
    );
    assert_eq!(
        refusal(300.0, Kind::SPEED),
        "a number without a unit is taken in m/s, and 300 m/s is not a plausible speed \
         (did you mean \"300 km/h\"? If not, write \"300 m/s\")"
    );
    assert_eq!(
        refusal(150.0, Kind::LENGTH),
        "a number without a unit is taken in m, and 150 m is not a plausible length \
         (write its unit, as in \"150 mm\", \"150 cm\", \"150 in\", \"150 ft\")"
    );
    // Too large in any of these units.
    assert!(refusal(1e300, Kind::LENGTH).contains("is too large for a length"));
    assert_eq!(
        refusal(0.01, Kind::MASS),
        "a number without a unit is taken in kg, and 0.01 kg is not a plausible mass \
         (write the unit, as in \"1500 kg\")"
    );
    assert_eq!(refusal(1e7, Kind::PURE), "`10000000` is too large for a pure number");
    for (value, kind) in [(std::f64::consts::TAU, Kind::ANGLE), (-30.0, Kind::YAW_RATE), (0.0, Kind::MASS)] {
        assert_eq!(bare("", value, kind).map(|read| read.si), Ok(value));
    }
    for (value, kind) in [(31.0, Kind::YAW_RATE), (-51.0, Kind::LENGTH), (1.1e9, Kind::YAW_INERTIA)] {
        assert!(bare("1", value, kind).is_err());
    }
}
