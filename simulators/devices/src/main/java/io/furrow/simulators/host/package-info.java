/** A fleet that runs what is requested on {@code service.devices}, and says on {@code service.devices.status} how it is. */
package io.furrow.simulators.host;
