/** What is known of the devices themselves, as the topic {@code service.devices} carries it. */
package io.furrow.model.device;
