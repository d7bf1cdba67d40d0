/** Runs a farm: schedules reports and sends them over the devices' connections. */
package io.furrow.simulators.fleet;
