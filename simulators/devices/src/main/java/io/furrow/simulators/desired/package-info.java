/** Brings the devices that run in line with those that are requested on {@code service.devices}. */
package io.furrow.simulators.desired;
