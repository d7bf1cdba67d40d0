/** Manages missions, their templates and their desired devices. */
package io.furrow.control.mission;
