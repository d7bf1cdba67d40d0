/** Draws the pictures of simulated cameras, without fonts or a display. */
package io.furrow.simulators.camera;
