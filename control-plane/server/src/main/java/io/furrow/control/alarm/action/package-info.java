/** What alarms trigger: webhooks, and stop commands for robots with their audit. */
package io.furrow.control.alarm.action;
