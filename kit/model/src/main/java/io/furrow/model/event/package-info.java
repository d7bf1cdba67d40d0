/** A change of an entity on a topic: its identity, its time, its headers, or a dead letter. */
package io.furrow.model.event;
