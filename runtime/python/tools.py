"""Responses as OpenMDAO, JAX and PyTorch know functions with derivatives of their own."""

import numpy as np


def on_rows(function, x, width):
    """Calls a function of rows for an array with any leading axes; `width` axes of each result are its own."""
    x = np.asarray(x, dtype=float)
    answer = np.asarray(function(x.reshape(-1, x.shape[-1])))
    return answer.reshape(x.shape[:-1] + answer.shape[1 : 1 + width])


def jax(response):
    """A function of arrays of shape (..., variables)."""
    import jax as library
    import jax.numpy as jnp

    def called(function, x, shape, width):
        dtype = jnp.result_type(x, jnp.float32)
        answer = lambda own: on_rows(function, own, width).astype(dtype)
        return library.pure_callback(
            answer, library.ShapeDtypeStruct(shape, dtype), x, vmap_method="broadcast_all"
        )

    @library.custom_jvp
    def value(x):
        x = jnp.asarray(x)
        return called(response, x, x.shape[:-1], 0)

    @value.defjvp
    def slope(primals, tangents):
        (x,), (dx,) = primals, tangents
        x = jnp.asarray(x)
        return value(x), jnp.sum(called(response.gradient, x, x.shape, 1) * dx, axis=-1)

    return value


def torch(response):
    """A function of tensors of shape (..., variables)."""
    import torch as library

    class Value(library.autograd.Function):
        @staticmethod
        def forward(ctx, x):
            ctx.save_for_backward(x)
            return library.as_tensor(on_rows(response, x.detach().cpu(), 0), dtype=x.dtype, device=x.device)

        @staticmethod
        @library.autograd.function.once_differentiable
        def backward(ctx, slope):
            (x,) = ctx.saved_tensors
            gradient = on_rows(response.gradient, x.detach().cpu(), 1)
            return slope[..., None] * library.as_tensor(gradient, dtype=x.dtype, device=x.device)

    return Value.apply


def openmdao(responses):
    """An explicit component: an input for each variable, an output for each response, all SI."""
    import openmdao.api as library

    first = next(iter(responses.values()))
    # Names of instances, `blade[1].mass`, are not those of OpenMDAO's variables.
    inputs = [name.replace("[", "_").replace("]", "").replace(".", "_") for name in first.names]

    class Mechanism(library.ExplicitComponent):
        def setup(self):
            for name, value in zip(inputs, first.nominal):
                self.add_input(name, val=value)
            for name, response in responses.items():
                self.add_output(name, val=response(first.nominal))
            self.declare_partials("*", "*")

        def point(self, values):
            return np.array([values[name].item() for name in inputs])

        def compute(self, values, answers):
            x = self.point(values)
            for name, response in responses.items():
                answers[name] = found(name, response(x))

        def compute_partials(self, values, partials):
            x = self.point(values)
            for name, response in responses.items():
                for own, slope in zip(inputs, found(name, response.gradient(x))):
                    partials[name, own] = slope

    def found(name, answer):
        """A design without an answer is one that a driver has to leave."""
        if np.isnan(answer).any():
            raise library.AnalysisError(f"{name}: no stable equilibrium, or no such response, at this design")
        return answer

    return Mechanism()
