/**
 * Types and attribute names of the entities that analytics writes: the contract between {@code analytics}, which writes
 * them, and the control plane and the command line, which read them.
 */
package io.furrow.model.result;
