C SPDX-License-Identifier: BSD-3-Clause
C
C The first code computes the rate RATE at which a round plate of radius
C 1 cools: dT/dt = Laplace T, with T = 1 - r**2 at the beginning and
C T = 0 on the rim. In the end only the slowest mode remains, which is
C J0(z r) exp(-z**2 t) with the first zero z of J0. The code uses linear
C finite elements with lumped mass, assembled from the stars of the
C nodes, and explicit Euler steps. Collective over ICOM.
      SUBROUTINE HEAT(ICOM, FOLDER, NNODES, RATE)
      INCLUDE 'nodes.inc'
      INTEGER ICOM, NSTEP
      CHARACTER*(*) FOLDER
      INTEGER*8 NNODES
      DOUBLE PRECISION RATE, DT, BEFORE, AFTER, TOTAL, LONGST
C     The rate is measured in the last quarter of the time TEND.
      DOUBLE PRECISION TEND
      PARAMETER (TEND = 0.4D0)
      ICOMM = ICOM
      CALL PLACE
      CALL TAKE(NNODES)
      CALL FLOWS
      CALL START
      NSTEP = 4 * (1 + INT(TEND / 4D0 / (0.9D0 * LONGST())))
      DT = TEND / NSTEP
      CALL MARCH(3 * NSTEP / 4, DT)
      BEFORE = TOTAL()
      CALL MARCH(NSTEP / 4, DT)
      AFTER = TOTAL()
      RATE = LOG(BEFORE / AFTER) / (TEND / 4D0)
      IF (FOLDER .NE. ' ') CALL PIECE(FOLDER)
      CALL GIVEUP
      END

C Places the nodes, on the communicator of the heat code, and stores the
C handles in the COMMON block. Collective.
      SUBROUTINE PLACE
      USE PNPBS
      INCLUDE 'nodes.inc'
      TYPE(PNPBS_CONTEXT) CTX
      TYPE(PNPBS_DOMAIN) DOM
      TYPE(PNPBS_PLACEMENT) PLC
      DOUBLE PRECISION CENTRE(2), TWOPI
      PARAMETER (TWOPI = 6.28318530717958648D0)
      DATA CENTRE /0D0, 0D0/
      CALL CTX%CREATE_MPI(ICOMM)
      CALL DOM%CREATE(CTX)
      CALL DOM%ADD_ARC(PNPBS_BOUNDARY, CENTRE, 1D0, 0D0, TWOPI, 1)
      CALL PLC%CREATE(CTX, DOM)
      CALL PLC%SET_SPACING_CONSTANT(0.05D0)
      CALL PLC%RUN
      HCTX = CTX%HANDLE()
      HDOM = DOM%HANDLE()
      HPLC = PLC%HANDLE()
      END

C Copies nodes, ghosts, stars and the halo exchange pattern into the
C COMMON blocks. Returns the number of nodes of all ranks in NNODES.
C Collective.
      SUBROUTINE TAKE(NNODES)
      USE PNPBS
      INCLUDE 'mpif.h'
      INCLUDE 'nodes.inc'
      TYPE(PNPBS_PLACEMENT) PLC
      INTEGER*8 NNODES, NENT, NSND, NRCV
      INTEGER IERR
      CALL PLC%FROM_HANDLE(HPLC)
      CALL PLC%GET('nodes', NNODES)
      CALL PLC%COUNT(NOWN)
      CALL PLC%GHOST_COUNT(NALL)
      NALL = NOWN + NALL
      CALL PLC%STAR_SIZE(NENT)
      CALL PLC%EXCHANGE_SIZES(NRANK, NSND, NRCV)
      IF (NALL .GT. MAXNOD .OR. NENT .GT. MAXENT .OR.
     &    NRANK .GT. MAXRNK .OR. NSND .GT. MAXNOD) THEN
        WRITE (0, *) 'the arrays of nodes.inc are too small'
        CALL MPI_ABORT(MPI_COMM_WORLD, 1, IERR)
      END IF
      CALL PLC%GET_NODES(XY, TAGS=ITAG)
      CALL PLC%GET_GHOSTS(XY(:, NOWN + 1:), TAGS=ITAG(NOWN + 1:))
      CALL PLC%GET_STARS(IOFF, NBR, ITRI)
      CALL PLC%GET_EXCHANGE(IRANK, ISOFF, ISND, IROFF, IRCV)
      END

C Destroys placement, domain and context. Collective.
      SUBROUTINE GIVEUP
      USE PNPBS
      INCLUDE 'nodes.inc'
      TYPE(PNPBS_CONTEXT) CTX
      TYPE(PNPBS_DOMAIN) DOM
      TYPE(PNPBS_PLACEMENT) PLC
      CALL CTX%FROM_HANDLE(HCTX)
      CALL DOM%FROM_HANDLE(HDOM)
      CALL PLC%FROM_HANDLE(HPLC)
      CALL PLC%DESTROY
      CALL DOM%DESTROY
      CALL CTX%DESTROY
      END

C Computes the coefficients of the heat flow between the nodes. A
C triangle I, J, K contributes half the cotangent of its angle at K to
C the coefficient of I and J, and a third of its area to node I.
      SUBROUTINE FLOWS
      INCLUDE 'nodes.inc'
      INTEGER*8 I, IE, JE, J, K
      DOUBLE PRECISION A2, COTJ, COTK
      DO 20 I = 1, NOWN
        DIAG(I) = 0D0
        AREA(I) = 0D0
        DO 10 IE = IOFF(I), IOFF(I + 1) - 1
          WGT(IE) = 0D0
   10   CONTINUE
        DO 20 IE = IOFF(I), IOFF(I + 1) - 1
          IF (ITRI(IE) .EQ. 0) GO TO 20
          JE = IE + 1
          IF (JE .EQ. IOFF(I + 1)) JE = IOFF(I)
          J = NBR(IE)
          K = NBR(JE)
          CALL CORNER(XY(1, I), XY(1, J), XY(1, K), A2, COTJ, COTK)
          WGT(IE) = WGT(IE) + COTK / 2D0
          WGT(JE) = WGT(JE) + COTJ / 2D0
          DIAG(I) = DIAG(I) + (COTJ + COTK) / 2D0
          AREA(I) = AREA(I) + A2 / 6D0
   20 CONTINUE
      END

C Computes A2, twice the area of the triangle P, Q, R, and COTQ and
C COTR, the cotangents of its angles at Q and R.
      SUBROUTINE CORNER(P, Q, R, A2, COTQ, COTR)
      DOUBLE PRECISION P(2), Q(2), R(2), A2, COTQ, COTR
      A2 = (Q(1) - P(1)) * (R(2) - P(2)) - (Q(2) - P(2)) * (R(1) - P(1))
      COTQ = ((P(1) - Q(1)) * (R(1) - Q(1))
     &        + (P(2) - Q(2)) * (R(2) - Q(2))) / A2
      COTR = ((P(1) - R(1)) * (Q(1) - R(1))
     &        + (P(2) - R(2)) * (Q(2) - R(2))) / A2
      END

C Sets the initial temperature.
      SUBROUTINE START
      INCLUDE 'nodes.inc'
      INTEGER*8 I
      DO 10 I = 1, NALL
        TEMP(I) = 0D0
        IF (ITAG(I) .EQ. 0) TEMP(I) = 1D0 - XY(1, I)**2 - XY(2, I)**2
   10 CONTINUE
      END

C Returns the longest stable time step. By Gershgorin's theorem no
C eigenvalue of the system exceeds the largest 2 DIAG / AREA, and the
C explicit Euler method is stable up to 2 over that. Collective.
      DOUBLE PRECISION FUNCTION LONGST()
      INCLUDE 'mpif.h'
      INCLUDE 'nodes.inc'
      DOUBLE PRECISION PART(1), WHOLE(1)
      INTEGER*8 I
      INTEGER IERR
      PART(1) = 1D0
      DO 10 I = 1, NOWN
        IF (ITAG(I) .EQ. 0) PART(1) = MIN(PART(1), AREA(I) / DIAG(I))
   10 CONTINUE
      CALL MPI_ALLREDUCE(PART, WHOLE, 1, MPI_DOUBLE_PRECISION, MPI_MIN,
     &                   ICOMM, IERR)
      LONGST = WHOLE(1)
      END

C Advances the temperature by N explicit Euler steps of length DT. Each
C step computes all flows before it changes a temperature. Collective.
      SUBROUTINE MARCH(N, DT)
      INCLUDE 'nodes.inc'
      INTEGER N, ISTEP
      INTEGER*8 I, IE
      DOUBLE PRECISION DT, FLOW(MAXNOD)
      SAVE FLOW
      DO 40 ISTEP = 1, N
        CALL GHOSTS
        DO 20 I = 1, NOWN
          FLOW(I) = 0D0
          IF (ITAG(I) .NE. 0) GO TO 20
          FLOW(I) = -DIAG(I) * TEMP(I)
          DO 10 IE = IOFF(I), IOFF(I + 1) - 1
            FLOW(I) = FLOW(I) + WGT(IE) * TEMP(NBR(IE))
   10     CONTINUE
   20   CONTINUE
        DO 30 I = 1, NOWN
          TEMP(I) = TEMP(I) + DT * FLOW(I) / AREA(I)
   30   CONTINUE
   40 CONTINUE
      END

C Updates the temperature at the ghosts from the ranks that own them.
C Collective.
      SUBROUTINE GHOSTS
      INCLUDE 'mpif.h'
      INCLUDE 'nodes.inc'
      INTEGER IREQ(2 * MAXRNK), K, N, IERR
      INTEGER*8 I
      DO 20 K = 1, NRANK
        N = INT(IROFF(K + 1) - IROFF(K))
        CALL MPI_IRECV(RBUF(IROFF(K)), N, MPI_DOUBLE_PRECISION,
     &                 IRANK(K), 1, ICOMM, IREQ(2 * K - 1), IERR)
        DO 10 I = ISOFF(K), ISOFF(K + 1) - 1
          SBUF(I) = TEMP(ISND(I))
   10   CONTINUE
        N = INT(ISOFF(K + 1) - ISOFF(K))
        CALL MPI_ISEND(SBUF(ISOFF(K)), N, MPI_DOUBLE_PRECISION,
     &                 IRANK(K), 1, ICOMM, IREQ(2 * K), IERR)
   20 CONTINUE
      CALL MPI_WAITALL(2 * NRANK, IREQ, MPI_STATUSES_IGNORE, IERR)
      DO 30 I = 1, NALL - NOWN
        TEMP(IRCV(I)) = RBUF(I)
   30 CONTINUE
      END

C Returns the heat in the whole plate, over all ranks. Collective.
      DOUBLE PRECISION FUNCTION TOTAL()
      INCLUDE 'mpif.h'
      INCLUDE 'nodes.inc'
      DOUBLE PRECISION PART(1), WHOLE(1)
      INTEGER*8 I
      INTEGER IERR
      PART(1) = 0D0
      DO 10 I = 1, NOWN
        PART(1) = PART(1) + AREA(I) * TEMP(I)
   10 CONTINUE
      CALL MPI_ALLREDUCE(PART, WHOLE, 1, MPI_DOUBLE_PRECISION, MPI_SUM,
     &                   ICOMM, IERR)
      TOTAL = WHOLE(1)
      END
