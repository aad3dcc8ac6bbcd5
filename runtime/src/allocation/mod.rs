//! The cheapest tolerances that meet requirements.
