/** Reports whether the control plane is alive and ready: its parts and dependencies, each with the age of its last success. */
package io.furrow.control.readiness;
