/** Missions, their templates and the devices that they want. */
package io.furrow.control.mission;
