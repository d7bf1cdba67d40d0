/** Alarms: what raises and ends them, their life, who is told, what is done. */
package io.furrow.control.alarm;
