/** Common parts of devices and load: their endpoints, and their provisioning. */
package io.furrow.simulators.device;
