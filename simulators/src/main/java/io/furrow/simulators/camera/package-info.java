/** The pictures that simulated cameras take: drawn by the program, without fonts or a display. */
package io.furrow.simulators.camera;
