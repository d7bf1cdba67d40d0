/** Positions of devices: reads them from reported entities, with what carries the device and how far it may be off. */
package io.furrow.analytics.collision.position;
