/** The pictures of simulated cameras, drawn without fonts or a display. */
package io.furrow.simulators.camera;
