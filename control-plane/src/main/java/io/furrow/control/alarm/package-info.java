/** Alarms: causes, life cycle, delivery by webhook, and automatic actions. */
package io.furrow.control.alarm;
