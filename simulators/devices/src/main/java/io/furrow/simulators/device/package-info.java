/** What devices and load have in common: the ends that they speak to, and how they are provisioned. */
package io.furrow.simulators.device;
