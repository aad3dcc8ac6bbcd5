//! Numbers of chance against exact ones: every probability that is called verified or trusted is right, near critical
//! states, at clusters and across branches.

mod bar;
mod branches;
mod equal;
mod limits;
mod models;
mod oracle;
mod words;
mod work;
