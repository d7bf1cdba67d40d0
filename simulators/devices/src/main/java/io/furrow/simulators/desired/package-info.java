/** Reconciles running devices with those desired on {@code service.devices}. */
package io.furrow.simulators.desired;
