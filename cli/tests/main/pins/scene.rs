//! The places and vectors of `draw`, computed by hand from the case file and from the JSON of `solve`, `slide` and `reconstruct`.

use serde_json::Value;

use super::{array, case, document, number};

/// The slide of the examples, with a crush on the front of vehicle 1 and skids before vehicle 2.
pub(super) fn by_hand() -> Value {
    let mut case = case("slide.toml");
    case["vehicle"][0]["crush"] = serde_json::json!({
        "width": 1.2, "depths": [0.1, 0.4, 0.3], "stiffness": [{ "to": 0.5, "A": 40_000, "B": 500_000 }, { "A": 30_000, "B": 400_000 }], "surface": "front",
    });
    case["vehicle"][0]["speed"] = "55 km/h ± 2 km/h".into();
    case["before"] =
        serde_json::json!({ "vehicle": { "2": { "skid": [{ "length": 12, "friction": 0.7 }, { "length": 3, "friction": 0.4 }] } } });
    for vehicle in ["1", "2"] {
        case["rest"]["vehicle"][vehicle]["position"] = serde_json::json!(["14 m ± 0.3 m", "9 m ± 0.2 m"]);
        case["rest"]["vehicle"][vehicle]["heading"] = "100 deg ± 5 deg".into();
    }
    case
}

fn pair(value: &Value) -> [f64; 2] {
    let of = |k: usize| number(&array(value)[k]);
    [of(0), of(1)]
}

fn assert_pair(value: &Value, wanted: [f64; 2]) {
    let found = pair(value);
    assert!((0..2).all(|k| (found[k] - wanted[k]).abs() < 1e-9), "{found:?}, not {wanted:?}");
}

fn assert_close(value: &Value, wanted: f64) {
    super::close(number(value), wanted, 1e-12, "a number of the scene");
}

#[test]
fn places_and_vectors_by_hand() {
    let case = by_hand();
    let drawn = document("draw", &case, &[]);
    let solved = document("solve", &case, &[]);
    assert_pair(&drawn["impact_point"], [12.3, 4.1]);
    assert_eq!((&drawn["is_on_scene"], number(&drawn["crush_plane"])), (&true.into(), 0.0));
    assert_pair(&drawn["impulse"], ["x", "y"].map(|axis| number(&solved["contact"]["impulse"][axis])));
    let [one, two] = [0, 1].map(|i| &drawn["vehicles"][i]);
    // Vehicle 1 heads along x with its impact center at (2, 0.3); vehicle 2 heads along y with it at (-0.6, 0.8): x = 12.3 + 0.8, y = 4.1 + 0.6.
    assert_pair(&one["position"], [10.3, 3.8]);
    assert_pair(&two["position"], [13.1, 4.7]);
    assert_close(&two["heading"], std::f64::consts::FRAC_PI_2);
    assert_pair(&two["impact_center"], [-0.6, 0.8]);
    // 1.15 m to the axle and 0.9 m beyond it, of 4.6 m.
    let outline = &one["outline"];
    for (key, wanted) in [("front", 2.05), ("rear", 2.55), ("half_width", 0.9)] {
        assert_close(&outline[key], wanted);
    }
    assert_eq!(outline["is_given"], true);
    assert_pair(&outline["wheels"][0], [1.15, 0.75]);
    assert_pair(&outline["wheels"][3], [-1.5, -0.75]);
    // Stations 0.6 m apart from left to right, about the impact center at 0.3 m left.
    let damage = &one["damage"];
    assert_eq!((&damage["surface"], &damage["is_given"]), (&"front".into(), &true.into()));
    for (k, depth) in [0.1, 0.4, 0.3].into_iter().enumerate() {
        let left = 0.9 - 0.6 * k as f64;
        assert_pair(&damage["undamaged"][k], [2.05, left]);
        assert_pair(&damage["crushed"][k], [2.05 - depth, left]);
    }
    assert_pair(&damage["borders"][0], [2.05, 0.4]);
    for (i, vehicle) in [one, two].into_iter().enumerate() {
        let solved = &solved["vehicles"][i];
        assert_eq!((&vehicle["name"], &vehicle["barrier"], &vehicle["before"]), (&solved["name"], &solved["barrier"], &solved["before"]));
        assert_eq!((&vehicle["after"]["velocity"], &vehicle["after"]["yaw_rate"]), (&solved["velocity"], &solved["yaw_rate"]));
        assert_eq!((&vehicle["delta_v"], &vehicle["pdof"]), (&solved["delta_v"], &solved["pdof"]));
        assert_pair(&vehicle["rest"]["position"], [14.0, 9.0]);
        assert_pair(&vehicle["rest"]["position_sd"], [0.3, 0.2]);
        assert_close(&vehicle["rest"]["heading"], 100f64.to_radians());
        assert_close(&vehicle["rest"]["heading_sd"], 5f64.to_radians());
    }
    // 55 ± 2 km/h at 95 %: 1.96 sd to each side; the other speed is certain.
    let sd = 2.0 / 3.6 * 1.959_963_984_540_054; // quantile of the normal distribution at 0.975
    assert_pair(&one["speed_range"], [55.0 / 3.6 - sd, 55.0 / 3.6 + sd]);
    assert!(two["speed_range"].is_null());
    let derivative = document("gradient", &case, &["--of", "vehicle.1.pdof", "--wrt", "vehicle.1.speed"]);
    let slope = number(&derivative["of"]["vehicle.1.pdof"]["d"]["vehicle.1.speed"]).abs() * sd;
    assert_pair(&one["pdof_range"], [number(&one["pdof"]) - slope, number(&one["pdof"]) + slope]);
    // One uncertain input moves the velocity along a line.
    for (i, vehicle) in [one, two].into_iter().enumerate() {
        let names = ["x", "y"].map(|axis| format!("vehicle.{}.velocity.{axis}", i + 1));
        let slopes = document("gradient", &case, &["--of", &names.join(","), "--wrt", "vehicle.1.speed"]);
        let [x, y] = names.map(|name| number(&slopes["of"][name]["d"]["vehicle.1.speed"]) * 2.0 / 3.6);
        let found = &vehicle["after"]["velocity_sd"];
        assert_close(&found["sd"][0], x.hypot(y));
        assert!(number(&found["sd"][1]) < 1e-7 * x.hypot(y));
        assert_close(&found["angle"], (y / x).atan());
    }
    // Skids end at the center of mass, straight behind it: 3 m and 12 m along y.
    assert_pair(&two["skids"][1][1], [13.1, 4.7]);
    assert_pair(&two["skids"][1][0], [13.1, 1.7]);
    assert_pair(&two["skids"][0][1], [13.1, 1.7]);
    assert_pair(&two["skids"][0][0], [13.1, -10.3]);
    assert_eq!(array(&one["skids"]).len(), 0);
    let message = array(&drawn["messages"]).iter().find(|message| message["code"] == "nominal-values").expect("one input is uncertain");
    assert_eq!((&message["severity"], &message["path"]), (&"note".into(), &"vehicle.1.speed".into()));
    assert!(array(&drawn["notes"]).contains(&message["text"]) && array(&message["figures"]).is_empty());
    // The slides are those of the verb.
    let slides = document("slide", &case, &[]);
    assert_eq!([&one["slide"], &two["slide"]], [&slides["vehicles"][0], &slides["vehicles"][1]]);
}

#[test]
fn phases_by_hand() {
    let case = by_hand();
    let (drawn, solved) = (document("draw", &case, &[]), document("solve", &case, &[]));
    let phases = array(&drawn["phases"]);
    let names: Vec<_> = phases.iter().map(|phase| phase["name"].as_str().unwrap_or_default()).collect();
    assert_eq!(names, ["before", "maximum compression", "after", "rest"]);
    // 0.6 of 4.6 m at 55 km/h.
    let time = 0.6 * 4.6 / (55.0 / 3.6);
    assert_close(&phases[0]["time"], -time);
    assert_close(&phases[1]["time"], 0.0);
    assert_close(&phases[2]["time"], time);
    assert!(phases[3]["time"].is_null());
    for i in 0..2 {
        let (vehicle, of) = (&drawn["vehicles"][i], &solved["vehicles"][i]);
        let (place, before, delta_v) = (pair(&vehicle["position"]), pair(&of["before"]["velocity"]), pair(&of["delta_v"]));
        assert_pair(&phases[0]["poses"][i]["position"], [0, 1].map(|k| place[k] - before[k] * time));
        assert_eq!(phases[0]["poses"][i]["heading"], vehicle["heading"]);
        assert_pair(&phases[0]["velocities"][i], before);
        assert_pair(&phases[1]["poses"][i]["position"], place);
        // The impulse at maximum compression is 1/(1 + 0.08) of the whole.
        assert_pair(&phases[1]["velocities"][i], [0, 1].map(|k| before[k] + delta_v[k] / 1.08));
        assert_pair(&phases[2]["velocities"][i], pair(&of["velocity"]));
        assert_eq!(phases[3]["poses"][i], vehicle["slide"]["rest"]);
        // After the impact the vehicle is between two states of its slide.
        let path = array(&vehicle["slide"]["path"]);
        let next = path.iter().position(|state| number(&state["t"]) >= time).expect("it slides longer");
        let at = pair(&phases[2]["poses"][i]["position"]);
        for (k, axis) in ["x", "y"].into_iter().enumerate() {
            let ends = [next - 1, next].map(|n| number(&path[n][axis]));
            assert!(at[k] >= ends[0].min(ends[1]) - 1e-12 && at[k] <= ends[0].max(ends[1]) + 1e-12, "{at:?} {ends:?}");
        }
    }
}

#[test]
fn a_reconstruction_is_drawn_with_its_intervals() {
    let case = case("reconstruct/two-cars.toml");
    let (drawn, found) = (document("draw", &case, &[]), document("reconstruct", &case, &[]));
    let ends = |interval: &Value| [number(&interval["low"]), number(&interval["high"])];
    assert_pair(&drawn["vehicles"][0]["speed_range"], ends(&found["unknown"]["vehicle.1.speed"]["interval"]));
    assert_pair(&drawn["vehicles"][1]["pdof_range"], ends(&found["derived"]["vehicle.2.pdof"]["interval"]));
    assert_close(&drawn["crush_plane"], number(&found["unknown"]["contact.crush_plane"]["value"]));
    for i in 0..2 {
        assert_eq!(drawn["vehicles"][i]["after"]["velocity"], found["solution"]["vehicles"][i]["velocity"]);
    }
    // Rest positions are counted from where each vehicle separated: 4.7 m and 4.5 m from it, in the file.
    let (from, to) = (pair(&drawn["vehicles"][0]["position"]), pair(&drawn["vehicles"][0]["rest"]["position"]));
    assert!((to[0] - from[0] - 4.7).abs() < 1e-9 && (to[1] - from[1] - 4.5).abs() < 1e-9);
}
