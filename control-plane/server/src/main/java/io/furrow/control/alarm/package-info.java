/** Manages alarms: their causes and life cycle. */
package io.furrow.control.alarm;
