/**
 * Detects missed notifications, reads the entities from the context broker and finds out which of their changes are not known.
 * Independent of Connect.
 */
package io.furrow.connect.repair;
