/** Acts on alarms: webhooks, and audited stop commands for robots. */
package io.furrow.control.alarm.action;
