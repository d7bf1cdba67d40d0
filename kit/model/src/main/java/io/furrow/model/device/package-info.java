/** The devices of a farm, as the topic {@code service.devices} contains them, and their credentials. */
package io.furrow.model.device;
