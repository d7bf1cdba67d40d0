/** Raises alarms from the results of analytics. */
package io.furrow.control.alarm.watch;
