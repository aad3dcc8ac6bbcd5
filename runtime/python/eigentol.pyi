"""Natural frequencies of mechanisms in steady motion, and how manufacturing tolerances move them.

A `Mechanism` is read from a file or a text; a `Study` of it is asked questions. Numbers are SI, texts have a unit
("3000 rpm"); modes are counted from 0, as arrays are. Where a result has no number, its array has NaN.
"""

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any, Literal, TypeAlias, TypedDict, final, type_check_only

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Self, Unpack

__version__: str

Real: TypeAlias = NDArray[np.float64]
Complex: TypeAlias = NDArray[np.complex128]
Flags: TypeAlias = NDArray[np.bool_]
Whole: TypeAlias = NDArray[np.int64]
Choices: TypeAlias = Mapping[str, tuple[Value, Value, tuple[float, float, float]]]
Value: TypeAlias = float | str
Numbers: TypeAlias = ArrayLike | Mapping[str, Value]
Ranges: TypeAlias = Mapping[str, tuple[Value, Value]]
Counts: TypeAlias = dict[str, int]
Table: TypeAlias = dict[str, Any]
Quantity: TypeAlias = Literal["frequency", "natural_frequency", "damping_ratio", "growth", "log_decrement"]
QuantityOrLambda: TypeAlias = Quantity | Literal["lambda"]
Measure: TypeAlias = Literal["displacement", "velocity", "acceleration"]
Family: TypeAlias = Literal["undamped", "general"]
Nominal: TypeAlias = dict[str, float]
Units: TypeAlias = dict[str, str]
Along: TypeAlias = tuple[str, ArrayLike] | tuple[str, ArrayLike, str]
FrequencyUnit: TypeAlias = Literal["Hz", "rad/s"]
Responsive: TypeAlias = Mapping[str, str]

@type_check_only
class UrdfOptions(TypedDict, total=False):
    """How a URDF file becomes a declaration."""

    base: Literal["fixed", "floating", "planar"]
    resistance: Literal["springs", "drives", "file", "none"]
    stiffness: float
    damping: float
    linear_stiffness: float
    linear_damping: float
    file_damping: bool
    nearest_inertias: bool
    name: str | None

@type_check_only
class Settings(TypedDict, total=False):
    """Settings of a study."""

    inputs: Mapping[str, Value]
    design: Mapping[str, Value]
    start: Mapping[str, Value]
    guess: Mapping[str, Value]
    hold: Mapping[str, Value]
    sigma_level: float
    tolerances: Mapping[str, Value | tuple[Value, Value]]
    measured: Mapping[str, ArrayLike]
    correlation: ArrayLike
    policy: Literal["stable", "nearest"]
    stay: bool
    at: Equilibrium
    family: Family
    samples: int
    seed: int
    stream: int
    threads: int
    keep_samples: bool
    steps: int
    vectors: bool

def json_schema() -> str:
    """The JSON Schema of the documents that `to_json` gives, as a text."""

def import_urdf(path: str | PathLike[str], **options: Unpack[UrdfOptions]) -> Import:
    """The declaration of a robot from its URDF file.

    Options: `base`, "fixed", "floating" or "planar"; `resistance` of the joints, "springs" on every coordinate,
    "drives" that hold at 0 the joints that nothing resists, or "none" for a mechanism of kernels alone; of springs
    `stiffness` (50 N m/rad), `damping` (0.5 N m s/rad), `linear_stiffness` (50 N/m), `linear_damping` (0.5 N s/m);
    `file_damping`, whether the damping of the file is taken (True); `nearest_inertias`, whether impossible inertias are
    replaced by the nearest possible ones (False); `name` of the mechanism.

    Raises OSError when the file cannot be read, DeclarationError with line and column of every mistake.
    """

def import_mjcf(path: str | PathLike[str], **options: Unpack[UrdfOptions]) -> Import:
    """The declaration of a model from its MuJoCo file (MJCF), with defaults and included files. Bodies and coordinates keep their names; coordinates
    are zero at the reference (`qpos` less `ref`). Joined bodies and coupled joints are exact, not soft. `notes` tells what a mechanism cannot
    express, such as contacts, motors and limits.

    Options as of `import_urdf`, of which `name` and `resistance` matter: unless given, what the file says resists its joints; "none" gives a
    mechanism of kernels alone, for a machine that nothing holds.

    Raises OSError when the file cannot be read, DeclarationError with line and column of every mistake.
    """

class Error(Exception):
    """Any failure of this module."""

class DeclarationError(Error, ValueError):
    """A text declares no mechanism. `mistakes` lists what is wrong, each with `line`, `column`, `end_line`, `end_column`, `message` and `help`; `path` is the file, or None."""

    mistakes: list[Mistake]
    path: PathLike[str] | None

class InvalidValue(Error, ValueError):
    """A value, unit, setting or list makes no sense (also a ValueError)."""

class UnknownName(Error, LookupError):
    """Nothing has this name (also a LookupError)."""

class NoEquilibrium(Error):
    """No equilibrium was found from the start values. `coordinates` is the last state, SI."""

    coordinates: list[float]

class NotAssembled(Error):
    """The constraints cannot be met together from the start values. `coordinates` is the last state, SI."""

    coordinates: list[float]

class NoModes(Error):
    """The modes were not found."""

class NoVibration(Error):
    """There is no steady vibration: nothing excites it, or it resonates without damping."""

class NoDerivative(Error):
    """A derivative does not exist at this state."""

class NotInRange(Error):
    """What was looked for is not in the range of the input."""

@type_check_only
class _Result:
    """What all results have."""

    def _repr_html_(self) -> str: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def table(self, name: str | None = None) -> Table:
        """A table of the result as a dictionary, a column for each heading ("frequency [rad/s]"), which
        pandas.DataFrame and polars.DataFrame take. Values are in declared units. Without a name it is the
        first, the answer.
        """
    def plot(self, ax: Any | None = None) -> Any:
        """Draws the figure of the result on matplotlib axes, new ones unless `ax` is given: one pair, or as many as
        the figure has panels. Returns the axes.

        Raises TypeError for a result that has no figure, ImportError without matplotlib.
        """
    def to_frame(self, name: str | None = None) -> Any:
        """A table of the result as a pandas.DataFrame; without a name the first, the answer."""
    def to_xarray(self, name: str | None = None) -> Any:
        """A table of the result as an xarray.Dataset, without a name the first. Its axes are the input that varies, and
        what tells the rows at one value apart: the mode, the output, the excitations. Units are attributes.

        Raises ValueError for a table whose rows have no axes.
        """
    def to_json(self) -> str:
        """The result as a JSON document, with every digit: what `eigentol --json` prints. Its schema is
        `eigentol.json_schema()`; under "result" it holds every number of the result, SI.
        """
    @classmethod
    def from_json(cls, text: str) -> Self:
        """The result that such a document holds, bit for bit. Raises InvalidValue for another text."""
    @property
    def tables(self) -> list[str]:
        """Names of the tables."""
    @property
    def notes(self) -> list[str]:
        """The sentences of its text: what to know besides the tables."""
    @property
    def mechanism(self) -> str | None:
        """Name of the mechanism; None where the result is an empty list."""
    @property
    def operating_point(self) -> dict[str, float]:
        """The inputs it belongs to, SI, by name, without one that varies; empty where derivatives are all there is."""

@final
class Clusters(_Result):
    """The modes that tolerances bring together. `k` is the number of clusters."""

    @property
    def modes(self) -> list[list[int]]:
        """Positions of the modes of each cluster, from 0."""
    @property
    def distances(self) -> Real:
        """Least distance of two members, in standard deviations of their difference, shape (k,)."""
    @property
    def eigenvalues(self) -> list[Complex]:
        """Nominal eigenvalues of each cluster: lambda (1/s^2) of undamped modes, s (1/s) of general ones, complex."""
    @property
    def equal(self) -> Flags:
        """Whether the members of each are equal in every design, shape (k,)."""
    @property
    def mean_eigenvalues(self) -> Complex:
        """Means of the eigenvalues of each, complex, shape (k,); NaN where they have merged."""
    @property
    def mean_frequency_sigmas(self) -> Real:
        """Standard deviations of the mean frequencies to first order, rad/s, shape (k,)."""
    @property
    def samples(self) -> Whole:
        """Numbers of samples behind the members of each, shape (k,)."""
    @property
    def failures(self) -> list[str | None]:
        """Why the members of a cluster have no spread: a text for each cluster, or None."""
    @property
    def family(self) -> Family | None:
        """"undamped" or "general"; None without clusters."""
    @property
    def defective(self) -> list[bool]:
        """Whether the members of each have merged into one eigenvalue that no derivative describes."""
    @property
    def unstable(self) -> Whole:
        """Numbers of samples that are unstable, shape (k,)."""
    @property
    def unsolved(self) -> Whole:
        """Numbers of samples that could not be solved, shape (k,)."""
    @property
    def sigma_level(self) -> float | None:
        """Standard deviations that a tolerance and a band stand for; None without clusters."""
    def mean(self, quantity: QuantityOrLambda = "frequency") -> list[Real]:
        """Means of the members of each cluster from the lowest up, and at last of the distance of the highest from the
        lowest: arrays of shape (members + 1,). The quantity is "frequency" (rad/s), "lambda" (1/s^2), "growth" (1/s) or
        "damping_ratio".
        """
    def sigma(self, quantity: QuantityOrLambda = "frequency") -> list[Real]:
        """Standard deviations likewise."""
    def __len__(self) -> int: ...

@final
class Mistake:
    """One mistake in a declaration."""

    def __new__(cls, line: int, column: int, end_line: int, end_column: int, message: str, help: str | None) -> Self: ...
    @property
    def line(self) -> int:
        """Line, from 1."""
    @property
    def column(self) -> int:
        """Column of its first character, from 1."""
    @property
    def end_line(self) -> int:
        """Line of its end."""
    @property
    def end_column(self) -> int:
        """Column behind its last character."""
    @property
    def message(self) -> str:
        """What is wrong."""
    @property
    def help(self) -> str | None:
        """What to do, or None."""

@final
class Live:
    """A page on this machine that answers while one edits: a notebook shows it, and any browser on this machine at its `address`.

    It ends with `stop()`, with its `with` block, or when nothing refers to it.
    """

    @property
    def address(self) -> str:
        """The address of the page. It holds a token: whoever knows it on this machine sees the page."""
    def stop(self) -> None:
        """Ends the page."""
    def _repr_html_(self) -> str: ...
    def __enter__(self) -> Self: ...
    def __exit__(self, _kind: Any, _value: Any, _trace: Any) -> None: ...

@final
class Mechanism:
    """A mechanism: names, units and kernels.

    It comes from a declaration in the language of eigentol, by `from_file` or `from_text`.
    """

    def residual(self, q: Numbers | None, inputs: Numbers | None = None, design: Numbers | None = None) -> Real:
        """Residual of the equations of motion at rest, N or N m, shape (n,). It is zero at an equilibrium."""
    def linear(
        self,
        q: Numbers | None,
        inputs: Numbers | None = None,
        design: Numbers | None = None,
    ) -> tuple[Real, Real, Real]:
        """Mhat, Chat and Khat about the state `q`: three arrays of shape (n, n), SI."""
    def linear_partials(
        self,
        q: Numbers | None,
        inputs: Numbers | None = None,
        design: Numbers | None = None,
    ) -> tuple[tuple[Real, Real, Real], tuple[Real, Real, Real], tuple[Real, Real, Real]]:
        """Explicit derivatives of Mhat, Chat and Khat, SI: for each matrix three arrays, by unknown, by input, by design
        variable, of shape (n, n, variables).
        """
    def residual_partials(
        self,
        q: Numbers | None,
        inputs: Numbers | None = None,
        design: Numbers | None = None,
    ) -> tuple[Real, Real]:
        """Explicit derivatives of the residual at rest by inputs, shape (n, inputs), and by design variables, shape (n,
        design), SI.
        """
    def mode_gradient(
        self,
        phi: Numbers | None,
        eigenvalue: float,
        q: Numbers | None,
        inputs: Numbers | None = None,
        design: Numbers | None = None,
    ) -> tuple[Real, Real, Real]:
        """Explicit gradient of `phi^T (Khat - lambda Mhat) phi`, SI, by unknowns, inputs and design variables: arrays of
        shapes (n,), (inputs,) and (design,). With `phi^T Mhat phi = 1` that is the one of the `eigenvalue` lambda of an
        undamped mode of shape `phi`, (n,), with the equilibrium held.
        """
    def residual_gradient(
        self,
        w: Numbers | None,
        q: Numbers | None,
        inputs: Numbers | None = None,
        design: Numbers | None = None,
    ) -> tuple[Real, Real, Real]:
        """Explicit gradient of `w^T g`, with `g` the residual at rest and `w` of shape (n,), SI, by unknowns, inputs and
        design variables: arrays of shapes (n,), (inputs,) and (design,).
        """
    def pencil_gradient(
        self,
        left: Numbers | None,
        acceleration: Numbers | None,
        velocity: Numbers | None,
        position: Numbers | None,
        q: Numbers | None,
        inputs: Numbers | None = None,
        design: Numbers | None = None,
    ) -> tuple[Real, Real, Real]:
        """Explicit gradient of `left^T (Mhat acceleration + Chat velocity + Khat position)`, four vectors of shape (n,), SI,
        by unknowns, inputs and design variables: arrays of shapes (n,), (inputs,) and (design,).
        """
    def output_values(self, q: Numbers | None, inputs: Numbers | None = None, design: Numbers | None = None) -> Real:
        """The declared outputs at the state `q`, SI, shape (outputs,)."""
    def forcing(
        self,
        q: Numbers | None,
        inputs: Numbers | None = None,
        design: Numbers | None = None,
    ) -> tuple[Complex, Real, Complex]:
        """The harmonic forces of every excitation about the state `q`, SI: with `F = forces[k]`, complex, excitation k acts
        on the equations as `Re(F e^{i w t})`, `w = frequencies[k]`, rad/s, which may be negative; `direct[k]`, complex, is
        what it adds to the outputs besides their dependence on the motion. Shapes (e, n), (e,) and (e, outputs), with e
        the number of excitations.
        """
    def output_motion(
        self,
        q: Numbers | None,
        inputs: Numbers | None = None,
        design: Numbers | None = None,
    ) -> tuple[Real, Real, Real]:
        """Derivatives of the outputs, as functions of any motion, by qddot, qdot and q, at the state of rest `q`, SI: three
        arrays of shape (outputs, n).
        """
    def motion_residual(
        self,
        acceleration: Numbers | None,
        velocity: Numbers | None,
        q: Numbers | None,
        inputs: Numbers | None = None,
        design: Numbers | None = None,
    ) -> Real:
        """Residual of the equations of the full nonlinear motion, N or N m, shape (n,): the forces that this motion would
        need besides those that act. `acceleration` is qddot, `velocity` qdot.
        """
    def motion_linear(
        self,
        acceleration: Numbers | None,
        velocity: Numbers | None,
        q: Numbers | None,
        inputs: Numbers | None = None,
        design: Numbers | None = None,
    ) -> tuple[Real, Real, Real]:
        """Derivatives of that residual by qddot, qdot and q: three arrays of shape (n, n), SI."""
    def mass_and_forces(
        self,
        velocity: Numbers | None,
        q: Numbers | None,
        inputs: Numbers | None = None,
        design: Numbers | None = None,
    ) -> tuple[Real, Real]:
        """Mass matrix and forces of the full nonlinear motion, `M qddot = Q`: shapes (n, n) and (n,), SI. `velocity` is
        qdot.
        """
    def accelerations(
        self,
        velocity: Numbers | None,
        q: Numbers | None,
        inputs: Numbers | None = None,
        design: Numbers | None = None,
    ) -> Real:
        """Accelerations of the full nonlinear motion, shape (n,), rad/s^2 or m/s^2; in the places of speeds their rates,
        in those of constraints the reactions. `velocity` is qdot.

        `Mechanism.motion` gives a right-hand side that integrators call.
        """
    def live(self, **settings: Unpack[Settings]) -> Live:
        """`Study(mechanism, **settings).live()`."""
    @property
    def name(self) -> str:
        """Its name."""
    @property
    def unknowns(self) -> list[str]:
        """Names of the unknowns in the order of arrays: coordinates (rad or m), after them those whose speed is the
        unknown (SI), after these the reactions of constraints (SI).
        """
    @property
    def coordinates(self) -> list[str]:
        """Names of the coordinates, those among them whose speed is the unknown: `eigentol check` counts the same."""
    @property
    def speeds(self) -> list[str]:
        """Names of the coordinates of which the speed, not the position, is the unknown."""
    @property
    def reactions(self) -> list[str]:
        """Names of the reactions of constraints."""
    @property
    def inputs(self) -> list[str]:
        """Names of the inputs in the order of arrays."""
    @property
    def design(self) -> list[str]:
        """Names of the design variables in the order of arrays."""
    @property
    def outputs(self) -> list[str]:
        """Names of the outputs in the order of arrays."""
    @property
    def excitations(self) -> list[str]:
        """Names of the excitations in the order of arrays."""
    @property
    def excitation_kinds(self) -> list[str]:
        """What each excitation was declared as: "unbalance", "harmonic" or "shaken"."""
    @property
    def excitation_orders(self) -> list[str]:
        """The frequency of each excitation in terms of the speeds of running coordinates: "1 spin"; empty for a frequency
        of its own.
        """
    @property
    def harmonics(self) -> list[list[str]]:
        """The harmonics of a forced response, each a list of the excitations that have one frequency in every design."""
    @property
    def nominal(self) -> Nominal:
        """The nominal design, SI, by name."""
    @property
    def units(self) -> Units:
        """The declared unit of every input, design variable, unknown and output, by name: "rpm"."""
    @classmethod
    def from_file(cls, path: str | PathLike[str]) -> Self:
        """The mechanism that a file declares.

        Raises OSError (FileNotFoundError ...) when the file cannot be read, DeclarationError with line and column of
        every mistake.
        """
    @classmethod
    def from_text(cls, text: str) -> Self:
        """The mechanism that a text declares: `mechanism Name { ... }`.

        Raises DeclarationError with line and column of every mistake.
        """
    @property
    def text(self) -> str:
        """The declaration."""
    def in_units(self, units: Mapping[str, str] | None = None, frequency: str | None = None) -> Self:
        """The same mechanism, whose answers state inputs, design variables, coordinates and outputs in these units, by name, and
        frequencies in the unit `frequency`: `mechanism.in_units({"orbit": "um"}, frequency="Hz")`. Arrays stay in SI.

        Raises UnknownName for a name that nothing has, InvalidValue for a text that is no unit of it.
        """
    def motion(self, inputs: Numbers | None = None, design: Numbers | None = None) -> Motion:
        """The nonlinear motion at these inputs and this design, for `scipy.integrate.solve_ivp`.

        Both are SI or texts with units, in a dictionary by name or in a list; unless given, inputs are zero and the
        design is nominal.
        """
    @classmethod
    def from_urdf(cls, path: str | PathLike[str], **options: Unpack[UrdfOptions]) -> Self:
        """The robot that a URDF file describes; options as of `import_urdf`, which also tells names and remarks."""
    @classmethod
    def from_mjcf(cls, path: str | PathLike[str], **options: Unpack[UrdfOptions]) -> Self:
        """The model that a MuJoCo file describes; `import_mjcf` also tells names and remarks."""

@final
class Motion:
    """The nonlinear motion at fixed inputs and design: `motion(t, y)` returns dy/dt, as `scipy.integrate.solve_ivp` wants
    it.

    `y` holds the coordinates (rad or m), after them their rates (rad/s or m/s), after these the speeds that are
    unknowns: `names` says which. Reactions of constraints are not part of it.
    """

    @property
    def names(self) -> list[str]:
        """Names of the entries of `y`; a rate is marked by a prime: "theta", "theta'"."""
    def __call__(self, t: float, y: ArrayLike) -> Real:
        """dy/dt at the state `y`, the same shape. `t` does not matter: inputs are constant."""
    def state(self, coordinates: Numbers | None = None, rates: Numbers | None = None) -> Real:
        """A state `y` from coordinates and speeds, and from rates, by name; zero unless given. SI or texts with units;
        rates are SI.
        """

@final
class PartialMonteCarlo:
    """Some samples of a Monte Carlo run: parts merge to the same bits as the whole, in any order and from any machine."""

    @property
    def ranges(self) -> list[tuple[int, int]]:
        """First sample and the one behind the last of each range that is done."""
    @property
    def missing(self) -> list[tuple[int, int]]:
        """The same of the ranges that are missing."""
    def to_json(self) -> str:
        """The text of a file: what the command `eigentol sample --partial` writes and `eigentol merge` reads."""
    @classmethod
    def from_json(cls, text: str) -> Self:
        """A part from such a text."""
    def merge(self, other: Self) -> None:
        """Adds samples of the same run; those of another one, and samples that are here already, are refused."""
    def result(self) -> MonteCarlo:
        """Statistics of the samples that are done."""

@final
class Response:
    """A number that a design gives: a quantity of a mode, an output, the amplitude of its vibration, a critical value of an
    input. `response(x)` evaluates
    it.

    `x` holds the variables `names`, SI: an array of shape (variables,), for one number, or of shape (N, variables), for
    an array of shape (N,). Every design is solved anew from the nominal equilibrium, its modes matched to the nominal
    ones by shape. NaN stands where a design has no stable equilibrium or no such response.

    For OpenTURNS:

        openturns.PythonFunction(
            len(response.names), 1,
            func=lambda x: [response(x)],
            func_sample=lambda xs: response(xs)[:, None],
            gradient=lambda x: response.gradient(x)[:, None],
        )
    """

    @property
    def names(self) -> list[str]:
        """Names of the variables, in the order of `x`."""
    @property
    def nominal(self) -> Real:
        """Nominal values of the variables, SI, shape (variables,)."""
    def __call__(self, x: ArrayLike) -> Any:
        """The response at a design, or at each of several, SI."""
    def gradient(self, x: ArrayLike) -> Real:
        """Total derivatives by the variables, SI: shape (variables,) for one design, (N, variables) for several."""
    def jax(self) -> Any:
        """For JAX: a function of arrays of shape (..., variables), SI, with the exact derivative in both directions (`grad`, `jvp`, `vmap`,
        `jit`). Without `jax_enable_x64` JAX rounds to single precision.
        """
    def torch(self) -> Any:
        """For PyTorch: a function of tensors of shape (..., variables), SI, with the exact first derivative."""

@final
class Answer(_Result):
    """A result as it describes itself: what is printed, tables, and every number behind them.

    `answer["sigma"]` is the column of that name or heading in the first table that has one, in the unit of
    `answer.units["sigma"]`: an array with NaN for missing numbers, or a list of texts or flags. Attributes are the fields
    of the result, SI, as its document has them under "result": a number, a text, an array for lists of numbers,
    however deep, and an object or a list of objects for what has fields again; the last axis of complex numbers has
    length two, so that `x @ [1, 1j]` is the complex array. `dir(answer)` lists them. A list of results has `entries`.
    """

    def __getitem__(self, name: str, /) -> Any:
        """The column of this name or heading, in its declared unit."""
    def __getattr__(self, name: str) -> Any:
        """A field of the result, SI."""
    def __dir__(self) -> list[str]: ...
    @property
    def units(self) -> dict[str, str]:
        """The units of the columns, by name."""
    @property
    def kind(self) -> str:
        """Its kind, as documents name it: "first-order spread"."""

@final
class Equilibrium(_Result):
    """An equilibrium and the linearised mechanism there, SI. `n` is the number of unknowns."""

    @property
    def inputs(self) -> Real:
        """The inputs it belongs to, SI, shape (inputs,)."""
    @property
    def design(self) -> Real:
        """The design variables it belongs to, SI, shape (design,)."""
    @property
    def mass(self) -> Real:
        """Mass matrix Mhat, shape (n, n)."""
    @property
    def damping(self) -> Real:
        """Damping and gyroscopic matrix Chat, shape (n, n)."""
    @property
    def stiffness(self) -> Real:
        """Stiffness matrix Khat, shape (n, n)."""
    @property
    def residual(self) -> Real:
        """Remaining residual, N or N m, shape (n,)."""
    @property
    def relative_residual(self) -> float:
        """Greatest remaining residual, relative to the forces in its own equation."""
    @property
    def stability(self) -> str:
        """What the mechanism would do there, in words."""
    @property
    def stable(self) -> bool:
        """Whether no small disturbance grows exponentially; nothing resists a neutral motion, which counts as stable."""
    @property
    def held(self) -> dict[str, float]:
        """The unknowns that hold it in a family of steady motions, with their values, SI."""
    @property
    def free(self) -> Real:
        """Motions that nothing resists, wherever the mechanism stands, shape (r, n)."""
    @property
    def rounding(self) -> float:
        """Estimated effect of rounding on the residual, relative to the forces in its equation."""
    @property
    def singular(self) -> bool:
        """Whether it is a singular configuration of the constraints."""
    @property
    def pose(self) -> tuple[str, float] | None:
        """The joint of three turns or the beam that is closest to its singular pose, and how far: 1 at best, 0 there.
        None without such joints and beams.
        """
    @property
    def left_unstable_region(self) -> bool:
        """Whether the search passed an unstable region: the start was not in the valley of the answer."""
    @property
    def kept(self) -> bool:
        """Whether it was asked for whatever its stability."""
    @property
    def names(self) -> list[str]:
        """Names of the unknowns."""
    @property
    def coordinates(self) -> Real:
        """The unknowns: coordinates (rad or m), after them speeds and reactions of constraints (SI), shape (n,)."""
    @property
    def iterations(self) -> int:
        """Iterations spent."""
    @property
    def freedom(self) -> int:
        """Number of coordinates that the constraints leave free."""
    @property
    def redundant(self) -> int:
        """Number of constraints that follow from others."""
    @property
    def dependent_constraints(self) -> list[str]:
        """Names of the constraints that depend on each other."""

@final
class ForcedResponse(_Result):
    """The steady vibration under the declared excitations, `Re(y e^{i w t})`. Amplitudes are complex, SI: the modulus is
    from 0 to peak, half of peak to peak; a positive phase leads, and NaN stands for an output that has a value but no
    derivative, like the length of a vector that is zero. `h` is the number of harmonics, `o` of outputs, `n` of
    unknowns, `e` of excitations.
    """

    @property
    def frequencies(self) -> Real:
        """Frequencies of the harmonics, rad/s, positive, shape (h,)."""
    @property
    def harmonics(self) -> list[list[str]]:
        """Names of the excitations that act together in each harmonic."""
    @property
    def outputs(self) -> Complex:
        """Amplitudes of the outputs, complex, SI, shape (h, o)."""
    @property
    def unknowns(self) -> Complex:
        """Amplitudes of the unknowns, complex, SI, shape (h, n): displacements of coordinates, speeds, reactions."""
    @property
    def excitations(self) -> list[str]:
        """Names of the excitations: the rows of `shares`."""
    @property
    def shares(self) -> Complex:
        """What each excitation contributes to the outputs, complex, SI, shape (e, o)."""
    @property
    def unknown_shares(self) -> Complex:
        """What each excitation contributes to the unknowns, complex, SI, shape (e, n)."""
    @property
    def reversed(self) -> Flags:
        """Whether the declared frequency of each excitation is negative, shape (e,)."""
    def amplitudes(self, measure: Measure = "displacement") -> Complex:
        """Amplitudes of the outputs, complex, shape (h, o): as "displacement" they are `outputs`, SI; as "velocity" per
        second, as "acceleration" per second squared.
        """
    def orbit_parts(self, x: str, y: str) -> tuple[Complex, Complex]:
        """The orbit of two outputs, which should be perpendicular displacements: `x + i y = f e^{i w t} + conj(b) e^{-i w t}`.
        The forward parts `f`, which circle from `x` to `y`, and the backward parts `b`, complex, SI, shape (h,) each.
        """
    def orbit_semi_axes(self, x: str, y: str) -> tuple[Real, Real]:
        """Half of the longest and half of the shortest diameters of the orbits of two outputs, SI, shape (h,) each."""
    def orbit_directions(self, x: str, y: str) -> Real:
        """Angles of the longest diameters of the orbits of two outputs from `x`, rad, shape (h,); NaN for a circle."""
    def orbit_turnings(self, x: str, y: str) -> list[str | None]:
        """How the orbits of two outputs are passed in each harmonic: "forward", from `x` to `y`, "backward", or None on a
        straight line.
        """
    def unknown_phases_quantile(self, probability: float, measure: Measure = "displacement") -> Real:
        """Amplitudes of the outputs that are not exceeded with a probability if only the amounts of the excitations are
        known, and their phases, such as the angles of unbalances, are independent and uniform over the turn: shape (h, o).
        0 gives the least possible, 1 the greatest.
        """
    def unknown_phases_root_mean_square(self, measure: Measure = "displacement") -> Real:
        """Roots of the mean squares of the amplitudes of the outputs under unknown phases, shape (h, o)."""
    def unknown_phases_probability(self, output: str, limit: Value, measure: Measure = "displacement") -> Real:
        """Probabilities that the amplitude of an output stays below a limit, SI or a text with a unit, under unknown phases,
        shape (h,).
        """

@final
class Modes(_Result):
    """The modes about an equilibrium: undamped ones ascending in frequency, general ones in frequency too, those that
    do not oscillate first. `m` is their number, `n` that of the unknowns.
    """

    @property
    def eigenvalues(self) -> Complex:
        """Eigenvalues `s`, 1/s, complex, shape (m,): motions go as exp(s t). Of a conjugate pair the one with positive
        imaginary part.
        """
    @property
    def state_space_eigenvalues(self) -> Complex:
        """All eigenvalues of the first-order form, 1/s, complex. The oscillating ones stand in ROSS's order: those with a
        positive imaginary part, ascending in it, after these their conjugates, again ascending. The real ones follow,
        ascending.

        A neutral undamped mode has two that are zero, a divergent one both signs.
        """
    @property
    def frequencies(self) -> Real:
        """Frequencies `Im s`, rad/s, shape (m,); NaN for a mode that does not oscillate."""
    @property
    def natural_frequencies(self) -> Real:
        """Natural frequencies `|s|`, rad/s, shape (m,); NaN for a mode that does not oscillate."""
    @property
    def damping_ratios(self) -> Real:
        """Damping ratios `-Re s / |s|`, shape (m,); NaN for a neutral mode."""
    @property
    def lambdas(self) -> Real:
        """`-Re s^2`, 1/s^2, shape (m,): of an undamped mode the eigenvalue of `Khat phi = lambda Mhat phi`."""
    @property
    def shapes(self) -> Complex:
        """Shapes, complex, shape (m, n): row `r` is mode `r`, with `phi^H Mhat phi = 1` where there are no speeds."""
    @property
    def left_shapes(self) -> Complex:
        """Left vectors, complex, shape (m, n)."""
    @property
    def errors(self) -> Real:
        """Estimated absolute errors of the eigenvalues, 1/s, shape (m,)."""
    @property
    def labels(self) -> Whole:
        """Numbers of the motions: modes with one label along a sweep are one motion."""
    @property
    def behaviours(self) -> list[str]:
        """What each mode does, in words."""
    @property
    def stable(self) -> bool:
        """Whether no small disturbance grows exponentially; nothing resists a neutral motion, which counts as stable."""
    @property
    def names(self) -> list[str]:
        """Names of the unknowns: the columns of the shapes."""
    @property
    def residuals(self) -> Real:
        """What is left of each eigenproblem, relative to its terms, shape (m,)."""
    @property
    def conditions(self) -> Real:
        """Condition numbers of the eigenvalues, shape (m,)."""
    @property
    def clusters(self) -> list[list[int]]:
        """For each mode the positions of all that are nearly equal to it, its own among them."""
    @property
    def damping_ignored(self) -> bool:
        """Whether undamped modes were asked for of a mechanism that is damped."""
    @property
    def family(self) -> Family:
        """"undamped" or "general"."""
    def __len__(self) -> int: ...

@final
class MonteCarlo(_Result):
    """Samples of the design, each with its own equilibrium and modes. `m` is the number of modes, `N` that of the
    samples; modes are in the order of the nominal ones.
    """

    @property
    def samples(self) -> int:
        """Number of samples."""
    @property
    def seed(self) -> int:
        """Seed of the random numbers."""
    @property
    def stream(self) -> int:
        """Which of the seed's independent sequences."""
    @property
    def on_another_branch(self) -> int:
        """How many stable samples lie on another branch of equilibria than the nominal one."""
    @property
    def designs(self) -> Real:
        """Design variables of the samples, SI, shape (N, design). The samples have to be kept (`keep_samples=True`)."""
    @property
    def coordinates(self) -> Real:
        """Equilibria of the samples, SI, shape (N, n); NaN where there is none."""
    @property
    def eigenvalues(self) -> Complex:
        """Eigenvalues of the samples, 1/s, complex, shape (N, m); NaN where there is none."""
    @property
    def frequencies(self) -> Real:
        """Frequencies of the samples, rad/s, shape (N, m)."""
    @property
    def damping_ratios(self) -> Real:
        """Damping ratios of the samples, shape (N, m)."""
    @property
    def outcomes(self) -> list[str]:
        """What became of each sample: "Stable", "Divergent", "Flutter", "NoEquilibrium" ..."""
    @property
    def planned(self) -> int:
        """Number of samples that were asked for: more than `samples` if the run was stopped or is a part."""
    @property
    def ranges(self) -> list[tuple[int, int]]:
        """First sample and the one behind the last of each range that is done."""
    @property
    def side_by_side(self) -> bool:
        """Whether samples were solved side by side in vectors."""
    @property
    def clustered(self) -> bool:
        """Whether some nominal modes have equal eigenvalues, and are told apart by their order only."""
    @property
    def family(self) -> Family:
        """"undamped" or "general"."""
    @property
    def varies(self) -> bool:
        """Whether any variable has a tolerance."""
    @property
    def counts(self) -> Counts:
        """How many designs became what, by name."""
    def mean(self, quantity: Quantity = "frequency") -> Real:
        """Means of "frequency" (rad/s) or "damping_ratio" over the stable samples, shape (m,)."""
    def sigma(self, quantity: Quantity = "frequency") -> Real:
        """Standard deviations likewise, shape (m,)."""
    def standard_error(self, quantity: Quantity = "frequency") -> Real:
        """Standard errors of the means, shape (m,); those of the standard deviations are `sigma_error`."""
    def sigma_error(self, quantity: Quantity = "frequency") -> Real:
        """Standard errors of the standard deviations, shape (m,), for any distribution."""
    def count(self, quantity: Quantity = "frequency") -> Real:
        """Number of samples in which each mode has the quantity, shape (m,)."""
    def skewness(self, quantity: Quantity = "frequency") -> Real:
        """Skewness, shape (m,)."""
    def skewness_error(self, quantity: Quantity = "frequency") -> Real:
        """Standard errors of the skewness of normal values, shape (m,)."""
    def excess_kurtosis(self, quantity: Quantity = "frequency") -> Real:
        """Excess kurtosis, shape (m,)."""
    def kurtosis_error(self, quantity: Quantity = "frequency") -> Real:
        """Standard errors of the kurtosis of normal values, shape (m,)."""
    def least(self, quantity: Quantity = "frequency") -> Real:
        """Least values, shape (m,)."""
    def greatest(self, quantity: Quantity = "frequency") -> Real:
        """Greatest values, shape (m,)."""
    def quantile(self, probability: float, quantity: Quantity = "frequency") -> Real:
        """Quantiles of "frequency" (rad/s) or "damping_ratio" over the stable samples for a probability between 0 and 1,
        shape (m,).
        """

@final
class Sensitivities(_Result):
    """Total derivatives of all modes, per SI unit of inputs and design variables. `m` is the number of modes."""

    @property
    def method(self) -> str:
        """How the derivatives were found, in words."""
    @property
    def by_design(self) -> Complex:
        """Derivatives of the eigenvalues `s` by design variables, 1/s per SI unit, complex, shape (m, design); NaN where
        `s` has none.
        """
    @property
    def by_input(self) -> Complex:
        """Derivatives of the eigenvalues `s` by inputs, 1/s per SI unit, complex, shape (m, inputs); NaN where `s` has
        none.
        """
    @property
    def lambda_by_design(self) -> Real:
        """Derivatives of `lambda = -Re s^2` by design variables, 1/s^2 per SI unit, shape (m, design)."""
    @property
    def lambda_by_input(self) -> Real:
        """Derivatives of `lambda = -Re s^2` by inputs, 1/s^2 per SI unit, shape (m, inputs)."""
    @property
    def clustered(self) -> list[bool]:
        """Whether each mode is one of a cluster of nearly equal eigenvalues: then its derivatives belong to the computed
        basis only.
        """
    @property
    def family(self) -> Family:
        """"undamped" or "general"."""
    def of(self, name: Quantity) -> tuple[Real, Real]:
        """Derivatives of a quantity, "frequency" (rad/s), "natural_frequency" (rad/s), "damping_ratio", "log_decrement" or
        "growth" (1/s), by inputs, shape (m, inputs), and by design variables, shape (m, design), per SI unit; NaN for a mode that has
        none.
        """

@final
class Sweep(_Result):
    """States along an input. `k` is their number, `n` that of the unknowns; a column of an array over modes is one
    motion.
    """

    @property
    def eigenvalues(self) -> Complex:
        """Eigenvalues, 1/s, complex, shape (k, motions); NaN where a motion was not found."""
    @property
    def frequencies(self) -> Real:
        """Frequencies, rad/s, shape (k, motions); NaN where a motion does not oscillate."""
    @property
    def damping_ratios(self) -> Real:
        """Damping ratios, shape (k, motions)."""
    @property
    def critical(self) -> Real:
        """Values of the input at which the stable equilibrium loses its stiffness, SI."""
    @property
    def critical_kinds(self) -> list[str]:
        """What happens at each of these, in words."""
    @property
    def flutter_onsets(self) -> Real:
        """Values of the input at which an oscillation begins or ceases to grow, SI."""
    @property
    def modes(self) -> list[Modes | None]:
        """The modes at each value, or None."""
    @property
    def values(self) -> Real:
        """Values of the input, SI, shape (k,)."""
    @property
    def coordinates(self) -> Real:
        """Unknowns of the equilibria, shape (k, n); NaN where there is none."""
    @property
    def failures(self) -> list[str | None]:
        """Why there is no equilibrium, or there are no modes, at each value: a text, or None where there are both."""
    @property
    def equilibria(self) -> list[Equilibrium | None]:
        """The equilibrium at each value, or None."""
    @property
    def searched(self) -> tuple[float, float, float] | None:
        """The range that was searched for events, SI: its ends, and how close two of them may be; or None."""
    @property
    def unsearched(self) -> list[tuple[float, float]]:
        """Stretches of it, SI, in which something may have been missed."""
    @property
    def unreached(self) -> int:
        """Number of values that were not reached."""
    @property
    def input(self) -> str:
        """Name of the input."""
    def __len__(self) -> int: ...

@final
class Import:
    """A robot as a declaration; numbers are SI."""

    def __new__(cls, declaration: str, names: Mapping[str, str], notes: Sequence[str]) -> Self: ...
    @property
    def declaration(self) -> str:
        """Text in the language of eigentol."""
    @property
    def names(self) -> dict[str, str]:
        """By the name in the declaration, that in the file: of every link and joint that had to be renamed."""
    @property
    def notes(self) -> list[str]:
        """What the declaration does not say, or says in another way than the file."""
    def mechanism(self) -> Mechanism:
        """The mechanism."""

@final
class Study:
    """A mechanism at one operating point, with tolerances and settings.

    Every value is a number, SI, or a text with a unit; a study starts from the declared nominal values and tolerances,
    with inputs and start values of zero.

        study = eigentol.Study(mechanism, inputs={"speed": "3000 rpm"}, tolerances={"l": "3%"})

    Settings:
      inputs, design: values by name.
      start: where the search for the equilibrium starts, by coordinate; held while a mechanism with loops is assembled.
      guess: the same for dependent coordinates, which move freely.
      hold: values of unknowns where steady motions come in a family; derivatives hold them too.
      stay: True for the equilibrium next to the start whatever its stability. Start values of an unstable equilibrium are kept
          without it: `notes` of the equilibrium says so.
      at: an equilibrium found by `equilibria`, whatever its stability.
      tolerances: by name of a design variable or an input: a half-width, a text ("3%", "+0.2 -0.1 mm uniform",
          "one of [9, 10] mm"), or a pair of deviations, lower and upper. Per cent given here are of the value that the
          study has, whatever `replace` changes; per cent of the declaration are of the declared nominal value of a design
          variable, also where `design` sets another, as in Rust and in the command.
      measured: arrays of measured values by name, SI, which take the place of a tolerance.
      sigma_level: standard deviations that a half-width stands for (3).
      correlation: matrix of the design variables, and after them of the inputs that have a tolerance.
      policy: "stable", or "nearest" for the equilibrium next to the start whatever its stability. With coasting joints, rolling
          wheels or forces without a potential, "stable" is the same as "nearest": look at `stability`.
      family: "undamped" or "general"; unless given, modes neglect nothing.
      samples (3000), seed (0), stream (0), threads (0: all), keep_samples (False), vectors (True): of sampling.
      steps: in which a range is searched (200).

    A study does not change: `replace` gives another one.
    """

    def __new__(cls, mechanism: Mechanism, **settings: Unpack[Settings]) -> Self: ...
    def allocate(
        self,
        requirements: Sequence[str],
        *,
        failure: Sequence[float],
        tolerances: Choices,
        nominals: Ranges | None = None,
    ) -> Answer:
        """The cheapest tolerances that meet requirements, as `chances` takes them; samples check what is found.

            study.allocate(
                ["frequency 1 >= 3.9 rad/s"],
                failure=[1e-3],
                tolerances={"l": ("0.1 mm", "5 mm", (0.0, 1e-3, 1.0))},
            )

        Arguments:
          failure: greatest probability of failing each requirement.
          tolerances: by name of a design variable, or of an input that has a tolerance: least and greatest half-width T, and what
              it costs, (fixed, factor, power): fixed + factor / T^power, T in SI.
          nominals: by name of a design variable that may move: least and greatest nominal value.
        """
    def clusters(self) -> Clusters:
        """The modes that tolerances bring together, and their spread."""
    def directional_derivatives(
        self,
        mode: int,
        inputs: Numbers | None = None,
        design: Numbers | None = None,
    ) -> Answer:
        """Derivatives of the eigenvalues in the cluster of a mode, counted from 0, along a change of inputs and design
        variables: lists, SI, or dictionaries by name; what is not named stays as it is. Equal eigenvalues split
        differently in each direction.
        """
    def live(self, port: int = 0) -> Live:
        """A page on this machine that answers while one edits, beginning with this study: sliders for all values and tolerances, modes
        in motion, sensitivities, bands, Campbell diagram and response. Saving the file of the mechanism updates it. `port` 0 is
        any that is free.

        Raises OSError when the port cannot be had.
        """
    def samples_between(self, start: int, stop: int) -> PartialMonteCarlo:
        """The samples `start` to below `stop` of `monte_carlo`, with the same seed: parts merge to the same bits as the
        whole run.
        """
    def assembly(self) -> Answer:
        """The state that closes the loops from the start values, before any equilibrium is looked for: which of the
        assemblies it is, and how far from a dead centre. Coordinates with a start value are held.
        """
    def equilibrium(self) -> Equilibrium:
        """Where the mechanism stays: equilibrium, Mhat, Chat, Khat, stability."""
    def equilibrium_shift(self) -> Answer:
        """How the equilibrium moves with inputs and design variables."""
    def modes(self) -> Modes:
        """How it vibrates about the equilibrium."""
    def sensitivities(self) -> Sensitivities:
        """Total derivatives of all modes."""
    def outputs(self) -> Answer:
        """The outputs and their total derivatives."""
    def forced_response(self) -> ForcedResponse:
        """The steady vibration under the declared excitations. Raises NoVibration where nothing excites one, and where a mode
        without damping resonates.
        """
    def forced_sensitivities(self) -> Answer:
        """The steady vibration and its total derivatives: equilibrium and frequencies follow the variables."""
    def share_sensitivities(self) -> Answer:
        """What each excitation contributes, and its total derivatives: a harmonic for every excitation alone, in the order of
        `mechanism.excitations`.
        """
    def forced_curvature(self) -> Answer:
        """The steady vibration with total first and second derivatives."""
    def output_tolerances(self) -> Answer:
        """First-order spread of the outputs."""
    def first_order(self) -> Answer:
        """First-order spread of all modes."""
    def second_order(self) -> Answer:
        """Spread of all modes to second order."""
    def summary(self) -> Answer:
        """First order, second order, and for each mode whether its standard deviation can be trusted. The samples that
        judge are always the same, whatever `samples` and `seed` of the study.
        """
    def propagate(self, responses: Sequence[str]) -> Answer:
        """How tolerances spread responses, by the method that suits them: texts such as "frequency 1", "angle", "vibration shake
        under u", "critical speed=0..6000rpm" or "resonance 1 speed=0..6000rpm", as `response` takes them.
        """
    def influence(self, responses: Sequence[str]) -> Answer:
        """Which variables the scatter of responses comes from; texts as `propagate` takes them."""
    def worst_case(self, responses: Sequence[str]) -> Answer:
        """The least and the greatest values of responses within the limits; texts as `propagate` takes them."""
    def branches(self, input: str, low: Value, high: Value) -> Answer:
        """Branches of equilibria along an input between two values, SI or texts with units."""
    def critical(self, input: str, low: Value, high: Value) -> Answer:
        """The first value of an input between two, SI or texts with units, at which the stable equilibrium loses its
        stiffness, and how tolerances move it. Raises NotInRange where there is none. A tolerance of this input counts
        with a derivative of -1, as the value that is set lies below the one that acts by the deviation; one in per cent
        is that at the operating point.
        """
    def critical_curvature(self, input: str, low: Value, high: Value) -> Answer:
        """First and second derivatives of that value by the design variables."""
    def flutter_onsets(self, input: str, low: Value, high: Value) -> Answer:
        """Values of an input between two, SI or texts with units, at which an oscillation begins or ceases to grow, and
        how tolerances move them.
        """
    def vibration_spread(self, vibrations: Sequence[str]) -> Answer:
        """How tolerances spread amplitudes of vibration, right at a resonance too: texts such as "vibration shake
        under u as velocity".
        """
    def converge(self, modes: int | None = None, along: str | None = None, orders: Sequence[float] = ...) -> Answer:
        """How far frequencies and damping ratios, of the first `modes` modes that oscillate or of all, and outputs change with
        one and with two more coordinates of each component of the beams. `along`, a range of an input such as
        "speed=0..6000rpm", adds the first critical value between them, onsets of flutter, where frequencies meet `orders`, and the
        highest peaks. Raises InvalidValue where there is no beam.
        """
    def bode(self, input: str, values: ArrayLike, unit: str | None = None) -> Answer:
        """Forced vibration at each value of an input: amplitudes and phases with their total derivatives. Values are SI,
        texts with units, or numbers in `unit`. A value without a vibration is NaN in arrays; `failures` says why.
        """
    def bode_bands(
        self,
        input: str,
        values: ArrayLike,
        vibrations: Sequence[str],
        checked: int = 64,
        unit: str | None = None,
    ) -> Answer:
        """The same with bands of these vibrations under tolerances, given as `vibration_spread` takes them. `checked`
        designs are solved anew at each value to say how good the bands are; 0 for none.
        """
    def peaks(
        self,
        vibration: str,
        input: str,
        low: Value,
        high: Value,
        operating: tuple[Value, Value] | None = None,
    ) -> Answer:
        """The peaks of a vibration, a text such as "vibration shake", between two values of an input: places, heights,
        half-power points and amplification factors, with their derivatives and spreads. With `operating`, the lowest and
        the highest value of the input in operation, SI or texts with units, how far the peaks keep away from these, and
        what their amplification factors ask for (API 617).
        """
    def mistuning(
        self,
        order: int,
        ring: str | None = None,
        coordinate: str | None = None,
        samples: int = 1000,
        seed: int = 0,
    ) -> Answer:
        """How much higher the worst blade of a ring vibrates than equal blades would under a force of an engine order, along a
        coordinate of the blades such as "flap", and the distribution within the tolerances. The first ring and the first
        coordinate are the defaults.
        """
    def monte_carlo(self) -> MonteCarlo:
        """Samples of the design, each with its own equilibrium and modes, on all processors. Ctrl-C ends it; to keep what
        is done, take the samples in parts (`samples_between`).
        """
    def equilibria(
        self,
        bounds: Ranges | None = None,
        starts: int | None = None,
        seed: int | None = None,
    ) -> list[Equilibrium]:
        """Equilibria found from random starts: between bounds for the coordinates that have some,
        `{"x": ("-10 mm", "10 mm")}`, and anywhere for other angles. A displacement needs bounds.
        """
    def whirls(self) -> Real:
        """Whirl of each mode, shape (m,): minor over major axis of the orbit, positive along the rotation; NaN where it
        does not apply.
        """
    def kinds(self) -> list[str | None]:
        """Kind of each mode, "lateral", "torsional", "axial", "mixed", or "blades"; None where neither shafts nor blades of a
        ring move.
        """
    def patterns(self) -> list[str | None]:
        """What the blades of a ring do in each mode: "collective", "differential", "regressive", "2 diameters"; None where
        there is no ring or its blades do not move.
        """
    def mode_curvature(self, mode: int) -> Answer:
        """First and second derivatives of one mode, counted from 0."""
    def output_curvature(self, output: str) -> Answer:
        """First and second derivatives of an output."""
    def shape_sensitivity(self, mode: int) -> Answer:
        """Derivatives of the shapes of one mode, counted from 0."""
    def sweep(self, input: str, values: ArrayLike, unit: str | None = None) -> Sweep:
        """Equilibria and modes along an input. Values are SI, texts with units, or numbers in `unit`."""
    def campbell(self, input: str, values: ArrayLike, orders: Sequence[float] = ..., unit: str | None = None) -> Answer:
        """A Campbell diagram: modes along an input with spreads, and where they meet `orders`, multiples of the input.
        Values are SI, texts with units, or numbers in `unit`.
        """
    def event_map(
        self,
        input: str,
        low: Value,
        high: Value,
        over: str,
        values: Sequence[Value],
        orders: Sequence[float] = ...,
    ) -> Answer:
        """Events along an input between two values, SI or texts with units, at each of the values of a design variable: a critical
        speed map over the stiffness of bearings, limits of stability over what cross-couples.
        """
    def crossings(self, input: str, low: Value, high: Value, order: float = 1.0, offset: float = 0.0) -> Answer:
        """Values of an input between two, SI or texts with units, at which a frequency equals `order` times the input and
        `offset` (rad/s) more, and how tolerances move them.
        """
    def motion_page(self) -> Any:
        """The equilibrium, modes and forced vibrations in motion: a page that a notebook shows, and that `save(path)` writes for
        a browser.
        """
    def plot_modes(self, ax: Any | None = None) -> Any:
        """Draws the modes on matplotlib axes: of beams the bent equilibrium and deflection curves of the first modes that
        oscillate, of other machines the shapes by coordinate, as `modes().plot()` does. Returns the axes.
        """
    def report(
        self,
        path: str | PathLike[str],
        sweep: Along | None = None,
        orders: Sequence[float] = ...,
        title: str | None = None,
        mode_names: Sequence[str] = ...,
        frequency_unit: FrequencyUnit | None = None,
    ) -> None:
        """Writes a report: one HTML file with the mechanism in 3-D, its modes in motion, charts, verdicts and tables.

        `sweep` is a tuple of the name of an input and values of it, SI or texts with units, and may have a unit for
        plain numbers as its third entry: `("speed", range(0, 6001, 100), "rpm")`. `orders` are multiples of that input
        whose crossings are marked. Samples and seed are those of the study. `mode_names` are what figures and sentences
        call the modes, the first one first, and `frequency_unit` is the unit of frequencies in them, `"Hz"` or
        `"rad/s"`.

        Raises OSError when the file cannot be written. What an analysis refuses is said in the report.
        """
    def chances(self, requirements: Sequence[str], start: int | None = None, stop: int | None = None) -> Answer:
        """Chances of meeting requirements, by sampling. Each is a text as on paper and in the shell, modes counted from 1: what
        `response` takes and a limit, "frequency 1 >= 20 Hz", "angle <= 5 deg", "frequency 1 within 4..5 Hz", "frequency 1
        outside 4..5 Hz", "frequency 1 away from 2 speed by 10%", or "stable". Of `start` and `stop` only the samples
        `start` to below `stop` are taken; numbers of samples of parts add up to those of the whole. Ctrl-C ends it.
        """
    def probability(self, requirements: Sequence[str]) -> Answer:
        """How probable it is that each requirement, and that any, is failed, with nothing to choose: by design points, lines
        of designs, or samples; requirements as `chances` takes them.
        """
    def reliability(self, requirements: Sequence[str]) -> Answer:
        """Reliability by way of design points (FORM), judged by designs solved anew; requirements as `chances`
        takes them.
        """
    def response(self, of: str, variables: Sequence[str] | None = None) -> Response:
        """A response as a function of arrays of designs.

        `of` is a text as in the shell, modes counted from 1: "frequency 1", "natural_frequency 1" (rad/s), "damping_ratio 1" or
        "growth 1" (1/s); the name of an output; "vibration shake", the amplitude (0 to peak) of an output under the
        excitations, with "under u" where they have several frequencies, and "as velocity" or "as acceleration";
        "vibration major(shake, lift)" or "minor(..)", a semi-axis of the orbit of two outputs; "vibration shake under all", the
        sum over all excitations, with "as rms" the root of the mean square;
        "vibration shake along speed=0..6000rpm", the greatest amplitude in a range of an input, and "peak shake along
        speed=0..6000rpm", the value of the input at its highest peak; "critical speed=0..6000rpm", where the equilibrium
        loses its stiffness; "resonance 1 speed=0..6000rpm order 2", where a frequency is 2 (1) times the input; "flutter 1
        speed=0..6000rpm", where a mode begins or ceases to grow. `variables` names the design variables that vary, in
        order; all unless given.
        """
    def openmdao(self, responses: Responsive, variables: Sequence[str] | None = None) -> Any:
        """For OpenMDAO: an `ExplicitComponent` with exact partial derivatives, an input for each of the `variables` and an output for
        each of the `responses`, texts as of `response` by name: `study.openmdao({"first": "frequency 1"})`. All is SI; of
        `blade[1].mass` the input is `blade_1_mass`. A design without an answer raises `AnalysisError`, from which drivers go back.
        """
    @property
    def settings(self) -> Settings:
        """The settings as given."""
    @property
    def inputs(self) -> Real:
        """Values of the inputs, SI, shape (inputs,)."""
    @property
    def design(self) -> Real:
        """Values of the design variables, SI, shape (design,)."""
    @property
    def sigmas(self) -> Real:
        """Standard deviations of the design variables, and after them of the inputs that have a tolerance, SI."""
    def replace(self, **settings: Unpack[Settings]) -> Self:
        """The same study with other settings. Dictionaries by name change the names in them only."""
    @property
    def mechanism(self) -> Mechanism:
        """The mechanism."""
    def motion(self) -> Motion:
        """The nonlinear motion at the inputs and the design of this study, for `scipy.integrate.solve_ivp`."""
