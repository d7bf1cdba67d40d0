/** Entities as read from the context broker, and which of their changes are known. */
package io.furrow.connect.repair.entity;
