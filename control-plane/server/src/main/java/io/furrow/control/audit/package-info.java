/** Defines the audit log: user, command, time and result. */
package io.furrow.control.audit;
