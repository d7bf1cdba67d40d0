/** Audit log: who issued which command, when, and its result. */
package io.furrow.control.audit;
