/** What alarms trigger: webhooks and stop commands for robots. */
package io.furrow.control.alarm.action;
