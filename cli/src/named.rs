//! Values by name, in their own order.

use std::fmt::Display;

use serde::{Serialize, Serializer};

/// A JSON object whose keys stand in the order in which they were given.
#[derive(Clone, Debug, PartialEq)]
pub struct Named<V>(Vec<(String, V)>);

impl<K: Display, V> FromIterator<(K, V)> for Named<V> {
    fn from_iter<I: IntoIterator<Item = (K, V)>>(pairs: I) -> Self {
        Named(pairs.into_iter().map(|(key, value)| (key.to_string(), value)).collect())
    }
}

impl<V: Serialize> Serialize for Named<V> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(key, value)| (key, value)))
    }
}

/// Zero without a sign.
pub fn plain(x: f64) -> f64 {
    x + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_order_is_kept() {
        let named: Named<f64> = [("b", 1.5), ("a", plain(-0.0))].into_iter().collect();
        assert_eq!(serde_json::to_string(&named).expect("plain data"), r#"{"b":1.5,"a":0.0}"#);
    }
}
