/** Commands to the control plane and its responses, as JSON on the topics of its managers. */
package io.furrow.model.control;
