/** Whether the control plane is alive and ready: its parts, and what they need, each with the age of its last success. */
package io.furrow.control.readiness;
