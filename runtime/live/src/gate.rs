//! Who is let in: requests to this host, with the token, from no other origin.

use hyper::header::{HOST, HeaderMap, ORIGIN};
use hyper::{Method, StatusCode};

use crate::Error;

/// What a request must show.
#[derive(Clone, Debug)]
pub(crate) struct Gate {
    port: u16,
    token: String,
}

/// What a request asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Asked {
    Page,
    News,
    Answer,
}

impl Gate {
    /// A gate with a new token.
    ///
    /// # Errors
    /// [`Error::Random`].
    pub(crate) fn new(port: u16) -> Result<Self, Error> {
        let mut bytes = [0_u8; 16];
        getrandom::fill(&mut bytes).map_err(Error::Random)?;
        Ok(Self { port, token: bytes.iter().map(|byte| format!("{byte:02x}")).collect() })
    }

    pub(crate) fn address(&self) -> String {
        format!("http://127.0.0.1:{}/{}/", self.port, self.token)
    }

    /// What is asked for, or why not.
    pub(crate) fn asked(
        &self,
        method: &Method,
        path: &str,
        headers: &HeaderMap,
    ) -> Result<Asked, (StatusCode, &'static str)> {
        let hosts = ["127.0.0.1", "localhost"].map(|host| format!("{host}:{}", self.port));
        let text = |name| headers.get(name).map(|value| value.to_str().unwrap_or_default());
        // A name of another that leads here would be another origin's way in.
        if !text(HOST).is_some_and(|host| hosts.iter().any(|own| own == host)) {
            return Err((StatusCode::FORBIDDEN, "this page answers at 127.0.0.1 only"));
        }
        let own = |origin: &str| hosts.iter().any(|own| origin.strip_prefix("http://") == Some(own));
        if text(ORIGIN).is_some_and(|origin| !own(origin)) {
            return Err((StatusCode::FORBIDDEN, "this page answers no other origin"));
        }
        let inside = path.strip_prefix('/').and_then(|path| path.strip_prefix(&*self.token));
        let Some(inside) = inside.and_then(|path| path.strip_prefix('/')) else {
            return Err((StatusCode::NOT_FOUND, "there is nothing here: the address holds a token"));
        };
        let (wanted, asked) = match inside {
            "" => (Method::GET, Asked::Page),
            "news" => (Method::POST, Asked::News),
            "answer" => (Method::POST, Asked::Answer),
            _ => return Err((StatusCode::NOT_FOUND, "there is nothing here")),
        };
        if *method == wanted { Ok(asked) } else { Err((StatusCode::METHOD_NOT_ALLOWED, "not in this way")) }
    }
}

#[cfg(test)]
mod tests {
    use hyper::header::HeaderValue;

    use super::*;

    #[test]
    fn only_this_host_with_the_token_and_no_other_origin() {
        let gate = Gate::new(8000).unwrap();
        let (page, answer) = (format!("/{}/", gate.token), format!("/{}/answer", gate.token));
        let asked = |method: &Method, path: &str, host: &str, origin: Option<&str>| {
            let mut headers = HeaderMap::new();
            headers.insert(HOST, HeaderValue::from_str(host).unwrap());
            if let Some(origin) = origin {
                headers.insert(ORIGIN, HeaderValue::from_str(origin).unwrap());
            }
            gate.asked(method, path, &headers).map_err(|(status, _)| status.as_u16())
        };
        let (get, post) = (Method::GET, Method::POST);
        assert_eq!(asked(&get, &page, "127.0.0.1:8000", None), Ok(Asked::Page));
        assert_eq!(asked(&post, &answer, "localhost:8000", Some("http://localhost:8000")), Ok(Asked::Answer));
        for host in ["evil.example:8000", "127.0.0.1", "127.0.0.1:8001", "127.0.0.1:8000.evil.example"] {
            assert_eq!(asked(&get, &page, host, None), Err(403), "{host}");
        }
        for origin in ["http://evil.example", "https://127.0.0.1:8000", "null", "http://127.0.0.1:8000.evil.example"] {
            assert_eq!(asked(&post, &answer, "127.0.0.1:8000", Some(origin)), Err(403), "{origin}");
        }
        for path in ["/", "/answer", "//", "/00000000000000000000000000000000/", "/../", &page[..20]] {
            assert_eq!(asked(&get, path, "127.0.0.1:8000", None), Err(404), "{path}");
        }
        for path in ["../../etc/passwd", "%2e%2e/", "answer/", "page"] {
            assert_eq!(asked(&get, &format!("{page}{path}"), "127.0.0.1:8000", None), Err(404), "{path}");
        }
        assert_eq!(asked(&get, &answer, "127.0.0.1:8000", None), Err(405));
        assert_ne!(Gate::new(8000).unwrap().token, gate.token);
    }
}
