/** Runs the fleet desired on {@code service.devices}, and publishes its status on {@code service.devices.status}. */
package io.furrow.simulators.host;
