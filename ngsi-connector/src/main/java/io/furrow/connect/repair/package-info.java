/**
 * Detects missed notifications, reads the entities from the context broker and finds the changes that are missing. Independent
 * of Connect.
 */
package io.furrow.connect.repair;
