//! `prove`: the error bounds of the proofs, and the errors in print.

use serde_json::json;

use super::paper::{parsed, printed_by, text};
use super::{array, close, number};

#[test]
fn what_is_proven_has_the_error_of_the_lemma() {
    /// The six greatest primes below 2⁶¹ are 2⁶¹ minus these (Caldwell, Prime Pages, "Primes just less than a power of two").
    const BELOW: [u64; 6] = [1, 31, 45, 229, 259, 283];
    let found = printed_by("prove");
    let primes: Vec<String> = BELOW.iter().map(|below| ((1_u64 << 61) - below).to_string()).collect();
    assert_eq!(found["primes"], json!(primes));
    let mut total = 0.0;
    for identity in array(&found["identities"]) {
        let [degree, points, bits] = ["degree", "points", "error_log2"].map(|key| number(&identity[key]));
        // At each point, the probability that a residue is zero by chance is at most degree/p (Schwartz and Zippel),
        // for each choice of n + 2 over 2 of the primes.
        let log = points * (61.0 - degree.max(1.0).log2()) - ((points + 2.0) * (points + 1.0) / 2.0).log2();
        assert_eq!(bits, -log.floor(), "{identity}");
        assert!(
            bits <= -100.0 && points >= 2.0 && number(&identity["points_redrawn"]) >= 0.0 && number(&identity["coefficient_bits"]) > 0.0
        );
        assert_eq!((&identity["holds"], &identity["verdict"]), (&json!(true), &json!("it holds")), "{identity}");
        for key in ["subject", "name", "statement"] {
            assert!(!text(identity, key).is_empty(), "{identity}");
        }
        assert!(identity["equations"].is_string());
        total += 2_f64.powf(bits);
    }
    let names: Vec<&str> = array(&found["identities"]).iter().map(|identity| text(identity, "name")).collect();
    for conclusion in array(&found["conclusions"]) {
        assert!(conclusion["holds"] == true && conclusion["reason"].is_string() && conclusion["statement"].is_string());
        assert!(array(&conclusion["premises"]).iter().all(|premise| names.contains(&premise.as_str().expect("a name"))), "{conclusion}");
    }
    for choice in array(&found["choices"]) {
        assert!(
            choice["holds"] == true
                && choice["points"] == found["fractions"]
                && !text(choice, "name").is_empty()
                && choice["statement"].is_string()
        );
    }
    for control in array(&found["controls"]) {
        assert!(
            control["told"] == true
                && text(control, "verdict") != "it holds"
                && control["statement"].is_string()
                && control["name"].is_string()
        );
    }
    for misprint in array(&found["misprints"]) {
        assert!(misprint["shown"] == true && !array(&misprint["findings"]).is_empty(), "{misprint}");
        for key in ["place", "stated", "holds", "breaks"] {
            assert!(!text(misprint, key).is_empty(), "{misprint}");
        }
        assert!(array(&misprint["findings"]).iter().any(|finding| finding["stated"] != finding["holds"]), "{misprint}");
        assert!(array(&misprint["inputs"]).iter().all(|input| input["name"].is_string() && fraction(text(input, "value")).is_finite()));
    }
    // Equations 7 and 8: the stated energies equal the correct ones with the opposite sign, and add up.
    let energies: Vec<[f64; 2]> = array(&found["misprints"][0]["findings"])
        .iter()
        .map(|finding| ["stated", "holds"].map(|key| fraction(text(finding, key))))
        .collect();
    assert!(energies.iter().all(|[stated, holds]| *stated == -holds && *holds > 0.0), "{energies:?}");
    close(energies[0][1] + energies[1][1], energies[2][1], 1e-12, "E_C + E_T");
    let count = |key: &str| array(&found[key]).len();
    let numbers: Vec<usize> = text(&found, "summary").split([' ', ';', ',']).filter_map(|word| word.parse().ok()).collect();
    let [identities, conclusions, choices, controls, misprints] =
        ["identities", "conclusions", "choices", "controls", "misprints"].map(count);
    assert_eq!(numbers, [identities, identities, conclusions, conclusions, choices, misprints, misprints, controls, controls]);
    let bits: f64 = text(&found, "summary").split_once("2^").expect("an error").1.split(' ').next().map(parsed).expect("a power");
    assert_eq!(bits, total.log2().ceil());
    assert_eq!((&found["schema"], &found["holds"], &found["problems"], &found["seed"]), (&json!(1), &json!(true), &json!([]), &json!(1)));
}

/// Parses a number or a quotient of whole numbers.
fn fraction(text: &str) -> f64 {
    text.split_once('/').map_or_else(|| parsed(text), |(numerator, denominator)| parsed(numerator) / parsed(denominator))
}
