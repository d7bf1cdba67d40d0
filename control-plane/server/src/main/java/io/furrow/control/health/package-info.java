/** Tracks the last report, the battery charge and the silence of devices. */
package io.furrow.control.health;
