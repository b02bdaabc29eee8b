import jax
import jax.numpy as jnp
import numpy as np

import planar_impact

CASE = planar_impact.template("t-bone")
INPUTS = ["vehicle.1.speed", "vehicle.2.speed", "contact.restitution"]
OUTPUTS = ["vehicle.1.delta_v_magnitude", "vehicle.2.delta_v_magnitude"]

jax.config.update("jax_enable_x64", True)


def solved(inputs):
    """Return outputs (rows, outputs) and their derivatives (rows, outputs, inputs)."""
    columns = dict(zip(INPUTS, np.asarray(inputs).T))
    answer = planar_impact.solve_batch(columns, of=OUTPUTS, wrt=INPUTS, derivatives="array", case=CASE)
    return np.stack([answer[name] for name in OUTPUTS], axis=-1), answer["derivatives"]


def on_host(inputs):
    shapes = (inputs.shape[0], len(OUTPUTS)), (inputs.shape[0], len(OUTPUTS), len(INPUTS))
    return jax.pure_callback(solved, tuple(jax.ShapeDtypeStruct(shape, inputs.dtype) for shape in shapes), inputs)


@jax.custom_jvp
def impact(inputs):
    """Return both ΔV of each row of `inputs`, a row being the numbers of INPUTS in SI. NaN where a row is refused."""
    return on_host(inputs)[0]


@impact.defjvp
def impact_jvp(primals, tangents):
    outputs, derivatives = on_host(*primals)
    return outputs, jnp.einsum("roi,ri->ro", derivatives, *tangents)


def loss(inputs):
    """The mean square of the ΔV of vehicle 1: what a planner may weigh."""
    return jnp.mean(impact(inputs)[:, 0] ** 2)


if __name__ == "__main__":
    crashes = jnp.array([[15.0, 8.0, 0.1], [12.0, 6.0, 0.2]])
    print(jax.jit(jax.value_and_grad(loss))(crashes))
